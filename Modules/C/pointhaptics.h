/**
 * @file
 * Feeling point clouds from C and every language that calls C: scenes, proxies, paths, and a servo loop.
 *
 * @code
 * ph_scene* scene = NULL;
 * ph_proxy* proxy = NULL;
 * ph_state state = { sizeof state };
 * if (ph_scene_create(points, count, NULL, &scene) || ph_proxy_create(NULL, &proxy))
 *   fprintf(stderr, "%s\n", ph_problem());
 * ph_proxy_set_scene(proxy, scene);
 * ph_proxy_step(proxy, hand, 0.001, &state); // state.force: newtons on the hand
 * @endcode
 *
 * Units are metres, newtons and seconds; points, hands and forces are in the frame of the points. Every
 * struct begins with its size, which the caller sets; 0 in another field means its default, and so does a
 * null pointer to options. Functions return PH_OK, which is 0, or a status; ph_message() is its sentence with
 * the cure, and ph_problem() says more of the last failure in the calling thread. None throws or prints.
 *
 * A scene is immutable and may be used by any number of threads at a time; the memory of the points is not
 * needed after ph_scene_create(). A scene that proxies, loops or calls still use lives until they let go of
 * it: ph_scene_destroy() is right at any time. A proxy or loop is used by one thread at a time.
 */
#ifndef POINTHAPTICS_H
#define POINTHAPTICS_H

#include <stddef.h>

#if defined(__GNUC__)
#define PH_API __attribute__((visibility("default")))
#else
#define PH_API
#endif

#ifdef __cplusplus
extern "C"
{
#endif

  /** The statuses that a caller may want to tell apart; ph_message() knows others, too. */
  enum
  {
    PH_OK = 0,
    PH_EMPTY = 1,              /**< No finite point, or none in the workspace. */
    PH_INVALID_PARAMETER = 12, /**< A number outside its range, or a null pointer. */
    PH_STOPPED = 13,           /**< ph_stop_request() ended the call. */
    PH_OUT_OF_MEMORY = 30
  };

  /** The version as text, "0.2.0". Static storage, as all texts here but ph_problem(). */
  PH_API const char* ph_version(void);
  /** One sentence that explains a status and names the cure. Never null. */
  PH_API const char* ph_message(int status);
  /** Problem of the last call that failed in this thread: argument, value and cure, in one line. Valid until
   * the next failure in this thread. Never null. */
  PH_API const char* ph_problem(void);

  /** Ends calls of other threads early: those that were given it return PH_STOPPED soon. */
  typedef struct ph_stop ph_stop;
  PH_API int ph_stop_create(ph_stop** out);
  /** Any thread; a signal handler, too. */
  PH_API void ph_stop_request(ph_stop* stop);
  PH_API void ph_stop_destroy(ph_stop* stop);

  /** A cloud as a hand feels it. */
  typedef struct ph_scene ph_scene;
  typedef struct
  {
    size_t struct_size;
    double voxel;        /**< Edge of the voxels that are felt, metres. Default: see dims. */
    double workspace[6]; /**< x0, x1, y0, y1, z0, z1: points outside are not felt. Default: all are felt. */
    int dims[3];         /**< Voxels on each axis. Default, without voxel: 300, and near the hand, where that
                              tells more, voxels about as fine as the points. */
    const ph_stop* stop; /**< Outlives the call. Default: the call goes on to its end. */
  } ph_scene_options;
  /** Points as x, y, z in turn. Cost: some nanoseconds a point and 20 ms a 100,000 voxels. */
  PH_API int ph_scene_create(
    const double* xyz, size_t count, const ph_scene_options* options, ph_scene** out);
  /** As ph_scene_create(), for float; @p stride: bytes from a point to the next one, 0 for 12. */
  PH_API int ph_scene_create_float(
    const float* xyz, size_t count, size_t stride, const ph_scene_options* options, ph_scene** out);
  /** One sentence on points far from all others, which a scene without a workspace leaves out; empty: there
   * are none. Valid as long as the scene. Never null. */
  PH_API const char* ph_scene_note(const ph_scene* scene);
  PH_API void ph_scene_destroy(ph_scene* scene);

  enum
  {
    PH_SURFACE_FIT = 0,    /**< A local fit of the surface: the accurate one. */
    PH_GRADIENT_STEPS = 1, /**< The paper's iteration. */
    PH_SPHERE = 2          /**< A sphere among the points. */
  };
  /** Gains of PH_GRADIENT_STEPS: see GradientStepsParameters. All are taken as they are: begin with
   * ph_gains_of(). */
  typedef struct
  {
    size_t struct_size;
    double free_gain, normal_gain, tangent_gain, sink_tolerance, step_period, largest_step;
    int maximum_steps, normalized_by_density;
  } ph_gains;
  enum
  {
    PH_TUNED = 0, /**< They follow a hand of 50 mm/s. */
    PH_PAPER = 1  /**< The gains that the paper prints. */
  };
  PH_API int ph_gains_of(int preset, ph_gains* out);

  /** How a surface feels. */
  typedef struct
  {
    size_t struct_size;
    double stiffness;      /**< N/m, up to 1e5. Default: 800. Negative: 0. */
    double damping;        /**< N s/m, 0 to 1e3, of the hand's speed along the normal, in contact. */
    double mu_s, mu_d;     /**< Static and dynamic friction, 0 to 10. Default of mu_s: mu_d. */
    double force_limit;    /**< N; infinity: none. Default: 8. */
    int method;            /**< PH_SURFACE_FIT, ... */
    const ph_gains* gains; /**< Default: PH_TUNED. */
  } ph_proxy_options;

  /** Result of a step: contact and force. */
  typedef struct
  {
    size_t struct_size;
    double proxy[3];  /**< The point of the proxy sphere nearest to the hand; out of contact the hand. */
    double normal[3]; /**< Outward unit normal. */
    double force[3];  /**< Force on the hand. */
    double radius;    /**< Radius of the proxy sphere. */
    int contact;      /**< 0 or 1. */
    unsigned status;  /**< Bits of pointhaptics::ProxyStatus. */
  } ph_state;
  /** The columns of the program's OUT.csv: t, hip xyz, proxy xyz, normal xyz, force xyz, radius, contact,
   * update_us. */
  enum
  {
    PH_COLUMNS = 16
  };

  /** A hand on a scene, in the caller's time. */
  typedef struct ph_proxy ph_proxy;
  PH_API int ph_proxy_create(const ph_proxy_options* options, ph_proxy** out);
  /** From the next step on; null: nothing is felt. */
  PH_API int ph_proxy_set_scene(ph_proxy* proxy, const ph_scene* scene);
  /** From the next step on; another method begins without contact. */
  PH_API int ph_proxy_set_options(ph_proxy* proxy, const ph_proxy_options* options);
  /** The hand is at @p hip; @p dt: seconds since the last step, above 0. A path felt step by step gives the
   * forces of ph_feel(), bit for bit. Cost: some microseconds, and now and then some milliseconds for a finer
   * scene about a hand that moves on. */
  PH_API int ph_proxy_step(ph_proxy* proxy, const double hip[3], double dt, ph_state* out);
  /** Steps as ph_proxy_step(), with the result as a row; its t counts from the first step. */
  PH_API int ph_proxy_step_row(ph_proxy* proxy, const double hip[3], double dt, double row[PH_COLUMNS]);
  PH_API void ph_proxy_destroy(ph_proxy* proxy);

  /** Number of steps that ph_feel() makes of @p count rows t, x, y, z at @p rate steps a second. */
  PH_API int ph_feel_steps(const double* path, size_t count, double rate, size_t* steps);
  /** Moves a hand along a path, linearly between its rows, in virtual time. @p rows has room for PH_COLUMNS
   * numbers in each of the steps. */
  PH_API int ph_feel(const ph_scene* scene, const double* path, size_t count, double rate,
    const ph_proxy_options* options, const ph_stop* stop, double* rows);

  /** One sentence, with the cure, where the sizes of @p scene and of a path make other units than metres and
   * seconds likely; else empty. @p touched: 0 where the path has passed the scene. Valid until the next call
   * in this thread. Never null. */
  PH_API const char* ph_unlikely_units(const ph_scene* scene, const double* path, size_t count, int touched);

  /** A servo loop in real time, with a thread of its own, over a simulated hand. */
  typedef struct ph_servo ph_servo;
  /** Called by the servo thread in each tick: the hand is at @p hand at @p time, seconds since the start, and
   * is to feel @p force, which may be written to. Other than 0: the loop ends, without a force. */
  typedef int (*ph_servo_tick)(void* user, double time, const double hand[3], double force[3]);
  typedef struct
  {
    size_t struct_size;
    double rate;           /**< Ticks a second, 1 to 10000. Default: 1000. */
    double mass;           /**< Mass of the hand, kg. Default: 0.1. */
    double grip_stiffness; /**< Between where the person wants the hand and the hand, N/m. Default: 200. */
    double grip_damping;   /**< N s/m. Default: 9. */
    double start[3];       /**< Where the hand begins, and the person wants it, metres. */
    double workspace[6];   /**< x0, x1, ...: the hand stays in it. Default: 10 cm about the start. */
    const double* path; /**< Rows t, x, y, z: where the person wants the hand. Default: ph_servo_target(). */
    size_t path_count;  /**< Rows of it. */
    ph_servo_tick on_tick; /**< Default: none. */
    void* user;            /**< Handed to on_tick. */
    int trace;             /**< Ticks kept for ph_servo_trace(). Default: 32768. */
  } ph_servo_options;
  typedef struct
  {
    size_t struct_size;
    double rate; /**< The rate that was reached. */
    double jitter_p50, jitter_p99, jitter_max, update_p50, update_p99, update_max; /**< Seconds. */
    unsigned long long ticks, deadline_misses, lost;                               /**< lost: of the trace. */
    int realtime; /**< SCHED_FIFO was granted. */
  } ph_servo_statistics;
  PH_API int ph_servo_start(
    const ph_scene* scene, const ph_proxy_options* proxy, const ph_servo_options* options, ph_servo** out);
  /** Where the person wants the hand. */
  PH_API int ph_servo_target(ph_servo* servo, const double target[3]);
  PH_API int ph_servo_set_options(ph_servo* servo, const ph_proxy_options* options);
  /** 1 while the thread runs; 0 after the end of a path, or after ph_servo_stop(). */
  PH_API int ph_servo_running(const ph_servo* servo);
  /** Moves at most @p most of the rows since the last call to @p rows, the oldest first; @p count: how many.
   */
  PH_API int ph_servo_trace(ph_servo* servo, double* rows, size_t most, size_t* count);
  PH_API int ph_servo_statistics_of(const ph_servo* servo, ph_servo_statistics* out);
  /** Takes the force away and ends the thread. Safe to call twice. */
  PH_API void ph_servo_stop(ph_servo* servo);
  /** Stops it. */
  PH_API void ph_servo_destroy(ph_servo* servo);

  /** For hosts that are interpreters with a lock, such as Python: long work of this process, VTK filters
   * included, gives it up. @p is_held: whether the calling thread has it; @p release gives it up, and @p take
   * gets it again with what that returned; @p is_ending, which may be null: whether it is given to nobody any
   * more; @p run_handlers, which may be null: runs handlers of signals in the main thread, with the lock, and
   * returns whether one has raised, which ends the work. */
  PH_API void ph_set_interpreter_lock(int (*is_held)(void), void* (*release)(void), void (*take)(void*),
    int (*is_ending)(void), int (*run_handlers)(void));
  /** At the end of such an interpreter: stops all work that gave the lock up, and returns when it has ended.
   * Its threads sleep until the process ends; what is begun from then on keeps the lock. Call it without the
   * lock. */
  PH_API void ph_end_interpreter(void);

#ifdef __cplusplus
}
#endif

#endif
