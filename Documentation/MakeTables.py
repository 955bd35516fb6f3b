#!/usr/bin/env python3
"""Makes tables, pictures and summary rows of the rows that pointhaptics-bench prints.

    pointhaptics bench resample > rows.jsonl
    Documentation/MakeTables.py rows.jsonl                     # tables on the terminal
    Documentation/MakeTables.py rows.jsonl -o Documentation    # into Performance.md and Accuracy.md

A table replaces the one between the marks <!-- bench TASK STUDY: begin --> and end, or goes to the end of its page;
a summary row replaces the one that asks the same with other numbers. Pictures need matplotlib; without it there are
tables only. Both forms of output are read: a row a line, and the document of --json.
"""
import argparse
import json
import pathlib
import re
import sys

TIMES = "median ms=1e3*median_seconds,quartiles ms=1e3*lower_quartile_seconds..upper_quartile_seconds"
FIGURES = ("median %=median_percent,p95 %=p95_percent,RMS %=rms_percent,dir p95=direction_p95_degrees,"
           "lost %=lost_percent,pops,phantom N=phantom_newton,held,strokes,judged %=judged_percent,releases,"
           "step p99=step_p99,max=largest_step,energy mJ=1e3*energy_joule,p50 us=p50_us,p99=p99_us,"
           "finding us=first_contact_us,max us=max_us")
# Columns of each study's table: TITLE=FACTOR*KEY, KEY..OTHER for a range, KEY.PART inside an object.
PERFORMANCE = {
    "resample points": "points,voxels on an axis=dimension,threads,contestant," + TIMES +
                       ",ns/point=ns_per_point,x ours=times_ours,voxels,answer",
    "resample modes": "points,contestant," + TIMES + ",ns/point=ns_per_point,x points alone=times_ours,voxels,answer",
    "io read": "file,MB=1e-6*bytes,contestant," + TIMES + ",first ms=1e3*first_seconds,x ours=times_ours,answer=right",
    "io write": "file,MB=1e-6*bytes,contestant," + TIMES + ",first ms=1e3*first_seconds,x ours=times_ours,answer=right",
    "io memory": "file,file MB=1e-6*file_bytes,result MB=1e-6*output_bytes,peak MB=1e-6*peak_bytes,"
                 "beyond MB=1e-6*beyond_bytes",
    "bandwidth search": "cloud,points,threads,contestant," + TIMES + ",ns/point=ns_per_point,x ours=times_ours,answer",
    "servo loop": "hand,machine=load,Hz=rate_hz,step us p50=1e6*step_seconds.p50,p99=1e6*step_seconds.p99,"
                  "p99.9=1e6*step_seconds.p999,max=1e6*step_seconds.max,jitter us p50=1e6*jitter_seconds.p50,"
                  "p99=1e6*jitter_seconds.p99,p99.9=1e6*jitter_seconds.p999,max=1e6*jitter_seconds.max,ticks,"
                  "deadline misses=deadline_misses,misses of an empty loop=empty_loop.deadline_misses,fps="
                  "frames_per_second,force=right",
    "render turning": "file,kind,points=all,level of detail=detail,drawn," + TIMES +
                      ",fps=frames_per_second,refined ms=1e3*refining_seconds,frames=refining_frames,"
                      "still ms=1e3*still_seconds",
    "render first_picture": "file,program,median s=median_seconds,quartiles s=lower_quartile_seconds.."
                            "upper_quartile_seconds,x ours=times_ours,peak MB=1e-6*peak_bytes",
}
ACCURACY = {
    "proxy methods": "shape,points,noise um=1e6*noise_metres,method,RMS %=rms_percent,max %=max_percent,"
                     "dir RMS=direction_rms_degrees,dir max=direction_max_degrees,step=largest_step,"
                     "energy J=energy_joule,pops=pop_throughs,false=false_ticks,p50 us=p50_us,p99=p99_us,"
                     "p99.9=p999_us,max us=max_us",
    "friction ratio": "method,shape,speed mm/s=1e3*speed_metres_per_second,mean ratio=mean_ratio,"
                      "RMS error %=rms_error_percent,max error %=max_error_percent,peak",
    "touch scans": "mesh,cloud,points,method,built s=built_seconds," + FIGURES,
    "touch hard": "scene=name,strokes,held,not let go=not_let_go,truth=truth_held,through=fell_through,"
                  "phantom %=phantom_percent,N=phantom_newton,lost %=lost_percent,median %=median_percent,"
                  "p95 %=p95_percent,energy mJ=energy_mj,force N=largest_newton,contact=contact_spacings,"
                  "trembles=oscillating,mJ over plane=energy_over_plane_mj,build s=build_seconds,"
                  "local ms=local_build_ms,p50 us=p50_us,p99 us=p99_us,limits=missed",
}
PAGES = {"Performance.md": PERFORMANCE, "Accuracy.md": ACCURACY}
COLUMNS = {**PERFORMANCE, **ACCURACY}
# Pictures of a study: file, title, x (TITLE=EXPRESSION), y, the key of the lines, what rows must have, joined points.
PICTURES = {
    "resample points": [
        ("resample-points", "Time of a point", "points=points", "time (ns)=ns_per_point", "contestant",
         {"threads": max, "dimension": 300}, True),
        ("resample-threads", "Mean resampling of the largest cloud", "threads=threads", "time (ms)=1e3*median_seconds",
         "contestant", {"points": max, "dimension": 300}, True)],
    "bandwidth search": [
        ("bandwidth-search", "Bandwidth and radius of every point of a sphere",
         "largest relative error=worst_relative_error", "time (ms)=1e3*median_seconds", "contestant",
         {"cloud": "sphere", "threads": max}, False)],
    "proxy methods": [
        ("proxy-time-error-%.0fum" % (1e6 * noise), "Torus, noise of %.0f um" % (1e6 * noise),
         "median update (us)=p50_us", "RMS force error (%)=rms_percent", "method",
         {"shape": "torus", "points": max, "noise_metres": noise}, False) for noise in (0.0, 20e-6, 100e-6)],
    "touch scans": [
        ("touch-time-error", "Every method on every mesh and cloud", "median update (us)=p50_us",
         "RMS force error (%)=rms_percent", "method", {}, False)],
    "render turning": [
        ("render-turning", "Turning the camera", "points=all", "frames a second=frames_per_second", "detail", {},
         True)],
}


def brief(value):
    """Three significant digits without an exponent where that stays short; grouped whole numbers."""
    if value is None or isinstance(value, (str, dict)):
        return value or ""
    if isinstance(value, bool):
        return "right" if value else "wrong"
    if isinstance(value, list):
        return "FAIL: " + ", ".join(value) if value else "pass"
    if value == int(value) and abs(value) < 1e15:
        return f"{int(value):,}"
    size = abs(value)
    if size < 1e-3 or size >= 1e6:
        return f"{value:.2e}"
    return f"{value:,.0f}" if size >= 100 else f"{value:#.3g}"


def value_of(row, key):
    """KEY, KEY.PART or FACTOR*KEY of a row; None where there is none."""
    factor, key = key.split("*") if "*" in key else ("", key)
    for part in key.split("."):
        row = row.get(part) if isinstance(row, dict) else None
    return float(factor) * row if factor and row is not None else row


def cell(row, expression):
    if ".." in expression:
        factor, keys = expression.split("*") if "*" in expression else ("1", expression)
        return " - ".join(brief(float(factor) * row[key]) for key in keys.split(".."))
    value = value_of(row, expression)
    return ("yes" if value else "no") if expression == "detail" else brief(value)


def table_of(study, rows):
    """The header and the cells. A study without columns of its own gets one for each key."""
    columns = COLUMNS.get(study) or ",".join(key for key, value in rows[0].items() if not isinstance(value, dict))
    pairs = [column.split("=") if "=" in column else [column, column] for column in columns.split(",")]
    return [title for title, _ in pairs], [[cell(row, expression) for _, expression in pairs] for row in rows]


def is_numeric(column):
    texts = [text for text in column if text]
    return bool(texts) and sum(bool(re.match(r"^-?[\d.,]+(e[+-]\d+)?$", text)) for text in texts) * 2 > len(texts)


def as_text(header, cells):
    columns = list(zip(header, *cells))
    right = [is_numeric(column[1:]) for column in columns]
    widths = [max(map(len, column)) for column in columns]
    return "\n".join("  ".join(text.rjust(w) if r else text.ljust(w) for text, w, r in zip(row, widths, right)).rstrip()
                     for row in zip(*columns)) + "\n"


def as_markdown(header, cells):
    right = [is_numeric(column) for column in zip(*cells)]
    lines = [header, ["---:" if r else "---" for r in right]] + cells
    framed = lambda text: text if text.startswith("---") else f" {text} "
    return "".join("|" + "|".join(map(framed, row)) + "|\n" for row in lines)


def read_runs(stream):
    """Runs of tasks: (head, {study: [rows]}, {study: [remarks]})."""
    text = stream.read()
    decoder, at, runs = json.JSONDecoder(), 0, []
    while at < len(text):
        value, at = decoder.raw_decode(text, at)
        at += len(text[at:]) - len(text[at:].lstrip())
        if "task" in value:
            runs.append(({key: value[key] for key in ("task", "command", "machine")}, {}, {}))
            for study, part in value.items():
                if isinstance(part, dict) and "rows" in part:
                    runs[-1][1][study], runs[-1][2][study] = part["rows"], part["remarks"]
        elif "remark" in value:
            runs[-1][2].setdefault(value["study"], []).append(value["remark"])
        else:
            runs[-1][1].setdefault(value.pop("study"), []).append(value)
    return runs


def machine_text(machine):
    return (f"Measured on: {machine['processor']}, {machine['cores']} cores, {machine['caches']}, "
            f"{machine['memory_gigabytes']:.0f} GiB; {machine['system']}; {machine['compiler']}; {machine['vtk']}; "
            f"load before the run {machine['load']:.1f}.")


def draw(study, rows, folder):
    """Draws the pictures of a study. Returns the lines that show them; none without matplotlib."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as pyplot
    except ImportError:
        return []
    shown = []
    for name, title, x, y, key, conditions, joined in PICTURES.get(study, []):
        chosen = [row for row in rows if all(
            row.get(k) == (v(r[k] for r in rows) if callable(v) else v) for k, v in conditions.items())]
        (x_title, x_key), (y_title, y_key) = x.split("="), y.split("=")
        lines = {}
        for row in chosen:
            point = value_of(row, x_key), value_of(row, y_key)
            if all(value and value > 0 for value in point):
                lines.setdefault(str(row[key]), []).append(point)
        if not lines:
            continue
        figure, axes = pyplot.subplots(figsize=(10, 6.4))
        for label, points in lines.items():
            name_of_line = f"level of detail {label}" if key == "detail" else label
            axes.plot(*zip(*sorted(points)), "o-" if joined else "o", label=name_of_line)
        axes.set(title=title, xlabel=x_title, ylabel=y_title, xscale="log", yscale="log")
        axes.grid(alpha=0.4)
        axes.legend()
        (folder / "Images").mkdir(exist_ok=True)
        figure.savefig(folder / "Images" / f"{name}.png", dpi=100)
        pyplot.close(figure)
        shown.append(f"![{title}](Images/{name}.png)\n")
    return shown


def last(rows, **conditions):
    """The last row with these values: tables grow downwards, so the largest."""
    found = [row for row in rows if all(row.get(key) == value for key, value in conditions.items())]
    return found[-1] if found else {}


def span(values):
    values = sorted(values)
    ends = brief(values[0]), brief(values[-1])
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def summary_of(study, rows):
    """(question, answer) pairs of a study. A KeyError or IndexError leaves the rest out: another run lacks it."""
    if study == "resample points":
        ours = last(rows, contestant="ours", dimension=300)
        pcl = [row for row in rows if row["contestant"].startswith("PCL") and row["threads"] == ours["threads"] and
               row["points"] == ours["points"] and row["dimension"] == 300][-1]
        yield (f"Mean resampling of {ours['points']:,} points, {ours['threads']} threads",
               f"{brief(1e3 * ours['median_seconds'])} ms; PCL takes {brief(pcl['times_ours'])} times as long")
    elif study == "io read":
        ply = {row["contestant"]: row for row in rows if row["file"] == "PLY binary"}
        vtp = last(rows, file="VTP", contestant="vtkXMLPolyDataReader")
        yield (f"Reading a binary PLY file of {brief(1e-6 * ply['ours']['bytes'])} MB",
               f"{brief(1e3 * ply['ours']['median_seconds'])} ms; PCL takes "
               f"{brief(ply['pcl::io::loadPLYFile']['times_ours'])} times as long, VTK "
               f"{brief(ply['vtkPLYReader']['times_ours'])}. VTK reads its own VTP in {brief(vtp['times_ours'])} of "
               "our time")
    elif study == "bandwidth search":
        ours = last(rows, contestant="ours", cloud="sphere")
        others = [row["times_ours"] for row in rows if row["cloud"] == "sphere" and row is not ours and
                  row["threads"] == ours["threads"]]
        yield (f"Bandwidths of {ours['points']:,} points, {ours['threads']} threads",
               f"{brief(1e3 * ours['median_seconds'])} ms; loops over other libraries' searches take {span(others)} "
               "times as long")
    elif study == "servo loop":
        idle = last(rows, hand="simulated hand", load="idle", rate_hz=1000.0)
        step = [brief(1e6 * idle["step_seconds"][key]) for key in ("p50", "p99", "max")]
        yield ("Servo loop at 1 kHz on an idle machine",
               f"step time p50 {step[0]} us, p99 {step[1]} us, max {step[2]} us; {idle['deadline_misses']:,} deadline "
               f"misses in {idle['ticks']:,} ticks, {idle['empty_loop']['deadline_misses']:,} in a loop that does "
               "nothing")
    elif study == "render turning":
        coarse, full = last(rows, detail=True), last(rows, detail=False)
        yield (f"Turning the camera about {coarse['all']:,} points, no graphics card",
               f"{brief(coarse['frames_per_second'])} frames a second; {brief(full['frames_per_second'])} without "
               "level of detail")
    elif study == "render first_picture":
        ours, f3d = last(rows, program="pointhaptics view"), last(rows, program="f3d")
        yield (f"From the program's start to the picture of {int(re.sub('[^0-9]', '', ours['file'])):,} points",
               f"{brief(ours['median_seconds'])} s, {brief(1e-6 * ours['peak_bytes'])} MB; f3d takes "
               f"{brief(f3d['times_ours'])} times as long and {brief(1e-6 * f3d['peak_bytes'])} MB")
    elif study == "proxy methods":
        errors = lambda noise: span(row["rms_percent"] for row in rows if row["noise_metres"] == noise and
                                    row["points"] == max(r["points"] for r in rows) and "default" in row["method"])
        largest = max(row["points"] for row in rows)
        yield (f"Force on exact shapes of {largest:,} points",
               f"RMS error {errors(0.0)} % without noise, {errors(1e-4)} % with 100 um of noise")
        torus = {row["method"]: row for row in rows if row["shape"] == "torus" and row["points"] == largest and
                 row["noise_metres"] == 0.0}
        yield ("The default method beside the paper's, on a torus",
               f"RMS error {brief(torus['surface-fit (default)']['rms_percent'])} %; the paper's "
               f"{brief(torus['gradient-steps, tuned']['rms_percent'])} %, with its printed gains "
               f"{brief(torus['gradient-steps, paper']['rms_percent'])} %")
    elif study == "friction ratio":
        fits = [row["rms_error_percent"] for row in rows if row["method"] == "surface-fit"]
        papers = [row["rms_error_percent"] for row in rows if row["method"] != "surface-fit"]
        yield ("Ratio of friction to normal force",
               f"RMS error at most {brief(max(fits))} %; the paper's method {span(papers)} %")
    elif study == "touch scans":
        fits = [row["median_percent"] for row in rows if row["method"] == "surface-fit"]
        balls = [row["median_percent"] for row in rows if row["method"] == "sphere"]
        yield ("Force beside a god object on the mesh itself, scans and machined parts",
               f"median error {span(fits)} %; without the fit {span(balls)} %")


def with_block(page, study, block):
    begin, end = (f"<!-- bench {study}: {word} -->" for word in ("begin", "end"))
    block = f"{begin}\n\n{block}\n{end}"
    first, final = page.find(begin), page.find(end)
    if first < 0 or final < first:
        return f"{page}\n{block}\n"
    return page[:first] + block + page[final + len(end):]


def with_summary(page, question, answer):
    """Replaces the answer of the row that asks the same with other numbers; a page without that row stays."""
    same = lambda text: re.sub(r"[\d,.]+", "#", text)
    lines = page.split("\n")
    for i, line in enumerate(lines):
        cells = line.split(" | ")
        if len(cells) == 3 and same(cells[0]) == same("| " + question):
            lines[i] = " | ".join(["| " + question, answer, cells[2]])
    return "\n".join(lines)


def write_pages(runs, folder):
    for head, studies, remarks in runs:
        for word, rows in studies.items():
            study = f"{head['task']} {word}"
            file = folder / next((page for page, columns in PAGES.items() if study in columns), "Performance.md")
            page = file.read_text() if file.exists() else f"# {file.stem}\n"
            block = [f"    {head['command']}\n", machine_text(head["machine"]) + "\n"]
            block += [as_markdown(*table_of(study, rows))]
            block += ["".join(f"- {remark}\n" for remark in remarks.get(word, []))] if remarks.get(word) else []
            page = with_block(page, study, "\n".join(block + draw(study, rows, folder)))
            try:
                for question, answer in summary_of(study, rows):
                    page = with_summary(page, question, answer)
            except (KeyError, IndexError):
                pass
            file.write_text(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", metavar="FILE", help="rows of pointhaptics-bench; default standard input")
    parser.add_argument("-o", "--output", metavar="FOLDER", type=pathlib.Path, help="folder of the pages")
    arguments = parser.parse_args()
    runs = []
    for stream in [open(name, encoding="utf-8") for name in arguments.files] or [sys.stdin]:
        runs += read_runs(stream)
    if arguments.output:
        write_pages(runs, arguments.output)
        return
    for head, studies, remarks in runs:
        print(f"{head['command']}\n{machine_text(head['machine'])}")
        for word, rows in studies.items():
            print(f"\n== {word}\n{as_text(*table_of(head['task'] + ' ' + word, rows))}", end="")
        for word in remarks:
            for remark in remarks[word]:
                print(f"  - {word}: {remark}")


if __name__ == "__main__":
    main()
