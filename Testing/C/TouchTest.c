/* The C interface from C99: a hand goes into a plate, step by step and along a path, from a scene in both precisions. */
#include <pointhaptics.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition) \
  do \
  { \
    if (!(condition)) \
    { \
      fprintf(stderr, "%s:%d: %s; %s\n", __FILE__, __LINE__, #condition, ph_problem()); \
      exit(1); \
    } \
  } while (0)

enum
{
  SIDE = 80,
  COUNT = SIDE * SIDE,
  STEPS = 201
};

static double points[3 * COUNT];
static float padded[4 * COUNT];
static double rows[STEPS][PH_COLUMNS];
static int ticks;
static double felt;

static int on_tick(void* user, double time, const double hand[3], double force[3])
{
  (void)user;
  (void)time;
  (void)hand;
  force[2] = 0.0;
  return ++ticks == 50;
}

static void feel_it(const ph_scene* scene)
{
  const double path[8] = { 0, 0, 0, 0.004, 0.2, 0, 0, -0.002 };
  size_t steps = 0;
  ph_proxy* proxy;
  double row[PH_COLUMNS];
  ph_state state;
  int i;
  CHECK(ph_feel_steps(path, 2, 1000.0, &steps) == PH_OK && steps == STEPS);
  CHECK(ph_feel(scene, path, 2, 1000.0, NULL, NULL, rows[0]) == PH_OK);
  felt = rows[STEPS - 1][12];
  CHECK(fabs(felt - 1.6) < 0.01); /* 800 N/m over 2 mm */
  CHECK(ph_proxy_create(NULL, &proxy) == PH_OK && ph_proxy_set_scene(proxy, scene) == PH_OK);
  for (i = 0; i < STEPS; ++i)
  {
    CHECK(ph_proxy_step_row(proxy, &rows[i][1], 0.001, row) == PH_OK);
    CHECK(memcmp(row, rows[i], 15 * sizeof(double)) == 0); /* all but update_us */
  }
  state.struct_size = sizeof state;
  CHECK(ph_proxy_step(proxy, &rows[STEPS - 1][1], 0.001, &state) == PH_OK);
  CHECK(state.contact == 1 && state.force[2] == rows[STEPS - 1][12]);
  CHECK(ph_proxy_step(proxy, row, 0.0, &state) == PH_INVALID_PARAMETER && strstr(ph_problem(), "dt"));
  CHECK(ph_proxy_set_scene(proxy, NULL) == PH_OK);
  for (i = 0; i < 1000; ++i) /* the force fades out */
  {
    CHECK(ph_proxy_step(proxy, &rows[STEPS - 1][1], 0.001, &state) == PH_OK);
  }
  CHECK(state.force[2] == 0.0);
  ph_proxy_destroy(proxy);
}

static void loop_it(const ph_scene* scene)
{
  ph_servo* servo;
  ph_servo_options options;
  size_t count = 0;
  memset(&options, 0, sizeof options);
  options.struct_size = sizeof options;
  options.on_tick = on_tick;
  options.start[2] = -0.001;
  CHECK(ph_servo_start(scene, NULL, &options, &servo) == PH_OK);
  while (ph_servo_running(servo))
  {
  }
  CHECK(ph_servo_trace(servo, rows[0], STEPS, &count) == PH_OK && count >= 50);
  CHECK(ticks == 50);
  ph_servo_destroy(servo);
}

int main(void)
{
  ph_scene_options options;
  ph_proxy_options wrong;
  ph_proxy* proxy;
  ph_scene* scene;
  ph_stop* stop;
  int i;
  for (i = 0; i < COUNT; ++i)
  {
    padded[4 * i] = (float)(0.0005 * (i % SIDE - SIDE / 2));
    padded[4 * i + 1] = (float)(0.0005 * (i / SIDE - SIDE / 2));
    points[3 * i] = padded[4 * i];
    points[3 * i + 1] = padded[4 * i + 1];
  }
  CHECK(ph_scene_create(points, COUNT, NULL, &scene) == PH_OK);
  feel_it(scene);
  loop_it(scene);
  ph_scene_destroy(scene);
  CHECK(ph_scene_create_float(padded, COUNT, 4 * sizeof(float), NULL, &scene) == PH_OK);
  feel_it(scene);
  ph_scene_destroy(scene);

  memset(&options, 0, sizeof options);
  options.struct_size = sizeof options;
  CHECK(ph_stop_create(&stop) == PH_OK);
  ph_stop_request(stop);
  options.stop = stop;
  CHECK(ph_scene_create(points, COUNT, &options, &scene) == PH_STOPPED);
  ph_stop_destroy(stop);
  options.stop = NULL;
  options.workspace[0] = 5.0;
  options.workspace[1] = 6.0;
  options.workspace[3] = options.workspace[5] = 1.0;
  CHECK(ph_scene_create(points, COUNT, &options, &scene) == PH_EMPTY && strstr(ph_problem(), "workspace"));
  options.voxel = -1.0;
  CHECK(ph_scene_create(points, COUNT, &options, &scene) == PH_INVALID_PARAMETER && strstr(ph_problem(), "voxel"));
  /* A struct of an older version ends before what came later. */
  options.struct_size = sizeof(size_t);
  CHECK(ph_scene_create(points, COUNT, &options, &scene) == PH_OK);
  ph_scene_destroy(scene);
  memset(&wrong, 0, sizeof wrong);
  wrong.struct_size = sizeof wrong;
  wrong.mu_d = 11.0;
  CHECK(ph_proxy_create(&wrong, &proxy) == PH_INVALID_PARAMETER && strstr(ph_problem(), "mu_d 11"));
  wrong.mu_d = 0.0;
  wrong.method = 7;
  CHECK(ph_proxy_create(&wrong, &proxy) == PH_INVALID_PARAMETER && strstr(ph_problem(), "method 7"));
  CHECK(ph_proxy_create(NULL, NULL) == PH_INVALID_PARAMETER && strstr(ph_problem(), "null"));
  CHECK(ph_scene_create(NULL, COUNT, NULL, &scene) == PH_INVALID_PARAMETER);
  CHECK(ph_proxy_step(NULL, points, 0.001, NULL) == PH_INVALID_PARAMETER);
  CHECK(strlen(ph_version()) >= 5 && strstr(ph_message(PH_OUT_OF_MEMORY), "memory"));
  printf("a hand felt %.1f N\n", felt);
  return 0;
}
