#!/usr/bin/env python3
"""Reads a result of Fenestra with Python's standard library alone.

    examples/analysis.py results/paper

prints per cell and detector: attempts, hit rate, bias and RMS of the depth error over the hits, and
the 95 % quantile of the centroid error over all attempts, a miss counting as infinite; then every
pair of detectors that saw the same trials, compared trial by trial. docs/results.md describes the
tables. A result may be read while a run is still writing it.
"""

import json
import math
import pathlib
import sqlite3
import sys


def open_result(path):
    file = pathlib.Path(path)
    if file.is_dir():
        file = file / "results.sqlite"
    if not file.is_file():
        sys.exit(f"{file}: there is no such file")
    store = sqlite3.connect(f"file:{file}?mode=ro", uri=True, timeout=60)
    store.row_factory = sqlite3.Row
    return store


def quantile(values, p):
    """The smallest value that a share p of all does not exceed."""
    return sorted(values)[max(math.ceil(p * len(values)) - 1, 0)]


def level_text(levels):
    return ", ".join(f"{name} {value}" for name, value in json.loads(levels).items()) or "-"


def print_cells(store):
    print(f"{'cell':>4}  {'levels':<32} {'detector':<16} {'n':>5} {'hit':>6} "
          f"{'bias z':>8} {'RMS z':>8} {'P95':>8}  [mm]")
    cells = store.execute("SELECT DISTINCT cell, detector, levels FROM trials ORDER BY 1, 2")
    for cell, detector, levels in cells:
        rows = store.execute(
            "SELECT outcome, centroid_error_z_mm AS z, centroid_error_mm AS length FROM trials "
            "WHERE cell = ? AND detector = ? AND truth_x_m IS NOT NULL "
            "AND outcome <> 'out_of_view'", (cell, detector)).fetchall()
        if not rows:
            continue
        depth = [row["z"] for row in rows if row["outcome"] == "hit"]
        lengths = [math.inf if row["length"] is None else row["length"] for row in rows]
        bias = sum(depth) / len(depth) if depth else math.nan
        rms = math.sqrt(sum(z * z for z in depth) / len(depth)) if depth else math.nan
        print(f"{cell:>4}  {level_text(levels):<32} {detector:<16} {len(rows):>5} "
              f"{len(depth) / len(rows):>6.1%} {bias:>8.2f} {rms:>8.2f} "
              f"{quantile(lengths, 0.95):>8.2f}")


def print_pairs(store):
    pairs = store.execute(
        "SELECT a.detector AS first, b.detector AS second, count(*) AS n, "
        "sum(a.centroid_error_mm < b.centroid_error_mm) AS wins "
        "FROM trials AS a JOIN trials AS b USING (cell, trial) "
        "WHERE a.detector < b.detector AND a.outcome = 'hit' AND b.outcome = 'hit' "
        "GROUP BY first, second ORDER BY first, second")
    for pair in pairs:
        print(f"{pair['first']} was nearer to the truth than {pair['second']} in {pair['wins']} of "
              f"{pair['n']} trials that both hit")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    store = open_result(sys.argv[1])
    about = dict(store.execute("SELECT key, value FROM meta"))
    runs = store.execute("SELECT count(*) FROM runs").fetchone()[0]
    print(f"{about['name']}, seed {about['seed']}, Fenestra {about['version']}, "
          f"{about['instruction_set']}, runs: {runs}")
    print_cells(store)
    print_pairs(store)


if __name__ == "__main__":
    main()
