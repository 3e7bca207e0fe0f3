#!/usr/bin/env python3
"""Tables for docs/detectors.md from two studies.

    ./run run detectors --no-pictures && ./run run windowless --no-pictures
    docs/detector_tables.py results/detectors results/windowless > tables.md
    docs/fill_tables.py tables.md docs/detectors.md

Every figure is the program's: `./run pool` takes cells together, with 95 % intervals that know which
rows share random numbers, and `./run check` holds them against docs/goals_detectors.yaml and
docs/goals_windowless.yaml. This script asks for them and sets them in tables.
"""
import csv
import io
import subprocess
import sys
import tempfile
from pathlib import Path

DOCS = Path(__file__).resolve().parent
RUN = DOCS.parent / "run"
DETECTORS = ["paper-stereo", "edge-stereo", "paper-rgbd", "plane-rgbd"]
LIGHTS = {"overcast": "cie_overcast", "sun": "cie_clear", "dusk": "uniform"}


def in_every_light(*prefixes):
    return [f"{prefix}-{light}" for prefix in prefixes for light in LIGHTS]


PARTS = {
    "painted": ["painted", "painted-rgbd"],
    "painted-calibrated": ["painted-calibrated"],
    "plain": in_every_light("plain-near", "plain", "plain-near-rgbd", "plain-rgbd"),
    "street": in_every_light("street", "street-rgbd"),
    "street-calibrated": ["street-calibrated"],
}


def pool(results, facade, by):
    """Metrics by name, by the values of `by` and the detector."""
    where = f"part in [{', '.join(PARTS[facade])}]"
    text = subprocess.run([RUN, "pool", results, "--csv", "--by", f"{by},detector" if by else "detector",
                           "--where", where], check=True, capture_output=True, text=True).stdout
    groups = {}
    for line in csv.DictReader(io.StringIO(text)):
        key = (line[by] if by else "", line["detector"])
        groups.setdefault(key, {})[line["figure"]] = line
    return groups


def figure(value):
    if value in (None, ""):
        return "–"
    value = float(value)
    if value in (float("inf"), float("-inf")):
        return str(value)
    return f"{value:.0f}" if abs(value) >= 99.5 else f"{value:.2g}"


def percent(value):
    text = f"{100.0 * float(value):.1f}"
    return text.removesuffix(".0") if float(value) in (0.0, 1.0) else text


def cell(metrics, name, form=figure):
    """The value and, where there is one, its interval."""
    line = metrics.get(name)
    if line is None:
        return "–"
    ends = [line["lower"], line["upper"]]
    text = form(line["value"])
    return f"{text} ({form(ends[0])} to {form(ends[1])})" if all(ends) else text


def table(header, rows):
    print("| " + " | ".join(header) + " |")
    print("|" + "|".join("---" if i == 0 else "---:" for i in range(len(header))) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


COLUMNS = ["in view", "hits [%]", "gross [%]", "wrong [%]", "bias x", "bias y", "bias z", "RMSE", "P95",
           "/ bound", "time"]


def summary(metrics):
    return [metrics["hit_rate"]["of"],
            *(cell(metrics, f"{name}_rate", percent) for name in ("hit", "gross", "wrong_window")),
            *(cell(metrics, f"bias_{axis}_mm") for axis in "xyz"), cell(metrics, "rmse_mm"),
            cell(metrics, "p95_error_mm"), cell(metrics, "rms_error_over_bound"),
            cell(metrics, "p50_time_ms")]


def by_distance(results, title, detectors):
    print(f"## {title}\n")
    rows = []
    for facade in PARTS:
        groups = pool(results, facade, "distance_m")
        for distance in sorted({key[0] for key in groups}, key=float):
            for detector in detectors:
                metrics = groups.get((distance, detector))
                if metrics and "hit_rate" in metrics:
                    rows.append([facade, f"{distance} m", f"`{detector}`"] + summary(metrics))
    table(["before", "from", "detector"] + COLUMNS, rows)


def by_condition(results):
    print("## By light and direction\n")
    rows = []
    for facade in ("plain", "street"):
        for by, values in (("sky_model", LIGHTS),
                           ("azimuth_deg", {f"{a}°": str(a) for a in (0, 20, 40, 50)})):
            groups = pool(results, facade, by)
            for name, value in values.items():
                of_all = [groups.get((value, detector), {}) for detector in DETECTORS]
                rows.append([facade, name] + [f"{cell(m, 'hit_rate', percent)}; "
                                              f"{cell(m, 'rms_error_over_bound')}" for m in of_all])
    table(["before", "condition"] + [f"`{d}`" for d in DETECTORS], rows)


def covariances(results):
    print("## Covariances\n")
    rows = []
    for facade in ("painted", "plain", "street"):
        groups = pool(results, facade, "")
        row = [facade]
        for detector in DETECTORS:
            metrics = groups.get(("", detector), {})
            within = metrics.get("within_covariance_rate")
            row.append("–" if within is None else
                       f"{cell(metrics, 'within_covariance_rate', percent)} % of {within['of']}; "
                       f"{cell(metrics, 'p50_normalised_square')}")
        rows.append(row)
    table(["before"] + [f"`{d}`" for d in DETECTORS], rows)


def goals(*results):
    """The program's own tables, what is not met first."""
    print("## Goals\n")
    for folder in results:
        file = DOCS / f"goals_{Path(folder).name}.yaml"
        with tempfile.NamedTemporaryFile("r", suffix=".md") as markdown:
            done = subprocess.run([RUN, "check", file, "--results", folder, "--markdown", markdown.name],
                                  capture_output=True, text=True)
            if done.returncode not in (0, 1):
                sys.exit(done.stderr)
            print("\n".join(line for line in Path(markdown.name).read_text().splitlines()
                            if not line.startswith(("<", "###"))).strip() + "\n")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    detectors, windowless = sys.argv[1:]
    by_distance(detectors, "Stereo", DETECTORS[:2])
    by_distance(detectors, "RGB-D", DETECTORS[2:])
    by_condition(detectors)
    covariances(detectors)
    goals(detectors, windowless)


if __name__ == "__main__":
    main()
