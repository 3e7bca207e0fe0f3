#!/usr/bin/env python3
"""Tables for docs/detectors.md from two studies.

    ./run run detectors --no-pictures && ./run run windowless --no-pictures
    docs/detector_tables.py results/detectors results/windowless > tables.md
    docs/fill_tables.py tables.md docs/detectors.md

RMSE / bound of several cells is the root mean square of each trial's error over its own bound, so
that near and far ones count alike. Its interval is a bootstrap over the trials (2,000 times, percentiles),
that of a share is Clopper and Pearson's; both 95 %. Whether a share is below a limit is told by the
one-sided bound. A normal error is six bounds long less than once in ten million times; how many are longer
is said, and the ratio of the others.
"""
import json
import math
import random
import sqlite3
import statistics
import sys
from pathlib import Path

from coverage import CHI2_OF_3_AT_95_PERCENT, solve

DETECTORS = ["paper-stereo", "edge-stereo", "paper-rgbd", "plane-rgbd"]
BOOTSTRAPS = 2000
FAR = 6.0


class Trial:
    def __init__(self, row):
        self.part, self.detector, levels, self.outcome = row[:4]
        self.levels = json.loads(levels)
        self.error_mm = row[4:7]
        bound = json.loads(row[7]) if row[7] else None
        self.bound_mm2 = [1e6 * bound[i][i] for i in range(3)] if bound else None
        self.covariance_m2 = json.loads(row[8]) if row[8] else None
        self.time_ms = 1e3 * sum(json.loads(row[9]).values()) if row[9] else None

    @property
    def is_hit(self):
        return self.outcome == "hit"

    @property
    def in_view(self):
        return self.outcome in ("hit", "gross", "wrong_window", "missed", "crashed")

    @property
    def length_mm(self):
        return math.hypot(*self.error_mm)

    def ratio(self, axes=(0, 1, 2)):
        return math.sqrt(sum(self.error_mm[i]**2 for i in axes)
                         / sum(self.bound_mm2[i] for i in axes))

    @property
    def normalised_square(self):
        error_m = [1e-3 * e for e in self.error_mm]
        return sum(e * w for e, w in zip(error_m, solve(self.covariance_m2, error_m)))

    @property
    def facade(self):
        return self.part.split("-")[0]

    @property
    def light(self):
        return next((x for x in ("overcast", "sun", "dusk") if x in self.part), None)

    @property
    def distance_m(self):
        given = {"plain-near-rgbd": 1.2, "plain-near": 1.0}
        near = next((d for part, d in given.items() if self.part.startswith(part)), None)
        return self.levels.get("distance_m", near)


def read(folder):
    path = Path(folder) / "results.sqlite"
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    return [Trial(row) for row in database.execute(
        "SELECT part, detector, levels, outcome, centroid_error_x_mm, centroid_error_y_mm,"
        " centroid_error_z_mm, bound_covariance_m2, estimate_covariance_m2, stage_times_s FROM trials"
        " ORDER BY cell, trial")]


def binomial_tail(n, k, p):
    """P(X >= k) of n with probability p."""
    if p <= 0.0 or p >= 1.0:
        return float(p >= 1.0 or k <= 0)
    def log_term(i):
        return (math.lgamma(n + 1) - math.lgamma(i + 1) - math.lgamma(n - i + 1)
                + i * math.log(p) + (n - i) * math.log1p(-p))
    return math.fsum(math.exp(log_term(i)) for i in range(k, n + 1))


def bisect(rising, target):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rising(middle) < target else (low, middle)
    return 0.5 * (low + high)


def clopper_pearson(k, n, tail):
    lower = 0.0 if k == 0 else bisect(lambda p: binomial_tail(n, k, p), tail)
    upper = 1.0 if k == n else bisect(lambda p: binomial_tail(n, k + 1, p), 1.0 - tail)
    return lower, upper


def root_mean_square(values):
    return math.sqrt(statistics.fmean(v * v for v in values))


def bootstrap(values):
    draw = random.Random(1)
    squares = [v * v for v in values]
    means = sorted(math.sqrt(statistics.fmean(draw.choices(squares, k=len(squares))))
                   for _ in range(BOOTSTRAPS))
    return means[int(0.025 * BOOTSTRAPS)], means[int(0.975 * BOOTSTRAPS)]


def percent(k, n):
    return "–" if n == 0 else f"{100.0 * k / n:.1f}" if k not in (0, n) else f"{100 * k // n}"


def figure(value):
    if value is None:
        return "–"
    return f"{value:.0f}" if abs(value) >= 99.5 else f"{value:.2g}"


def table(header, rows):
    print("| " + " | ".join(header) + " |")
    print("|" + "|".join("---" if i == 0 else "---:" for i in range(len(header))) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def summary(trials):
    seen = [t for t in trials if t.in_view]
    hits = [t for t in seen if t.is_hit]
    count = lambda outcome: sum(t.outcome == outcome for t in seen)
    cells = [str(len(seen)), percent(len(hits), len(seen)), str(count("gross")),
             str(count("wrong_window"))]
    if hits:
        bias = [figure(statistics.fmean(t.error_mm[i] for t in hits)) for i in range(3)]
        lengths = sorted(t.length_mm for t in hits)
        bounded = [t.ratio() for t in hits if t.bound_mm2]
        cells += [", ".join(bias), figure(root_mean_square(lengths)),
                  figure(lengths[math.ceil(0.95 * len(lengths)) - 1]),
                  figure(root_mean_square(bounded)) if bounded else "–"]
    else:
        cells += ["–"] * 4
    times = [t.time_ms for t in trials if t.time_ms]
    return cells + [figure(statistics.median(times)) if times else "–"]


COLUMNS = ["in view", "hits [%]", "gross", "wrong", "bias x, y, z", "RMSE", "P95", "/ bound", "time"]


def by_distance(trials, title, detectors):
    print(f"## {title}\n")
    rows = []
    facades = ["painted", "painted-calibrated", "plain", "street", "street-calibrated"]
    for facade in facades:
        chosen = [t for t in trials if t.detector in detectors
                  and (t.part == facade or t.part == facade + "-rgbd"
                       or (t.facade == facade and t.light))]
        for distance_m in sorted({t.distance_m for t in chosen}):
            for detector in detectors:
                these = [t for t in chosen
                         if t.distance_m == distance_m and t.detector == detector]
                rows.append([facade, f"{distance_m:g} m", f"`{detector}`"] + summary(these))
    table(["before", "from", "detector"] + COLUMNS, rows)


def by_condition(trials):
    print("## By light and direction\n")
    rows = []
    for facade in ("plain", "street"):
        for name, key, values in (("light", lambda t: t.light, ("overcast", "sun", "dusk")),
                                  ("azimuth", lambda t: t.levels.get("azimuth_deg"),
                                   (0.0, 20.0, 40.0, 50.0))):
            for value in values:
                row = [facade, value if name == "light" else f"{value:.0f}°"]
                for detector in DETECTORS:
                    these = [t for t in trials if t.facade == facade and t.light
                             and key(t) == value and t.detector == detector]
                    seen = [t for t in these if t.in_view]
                    hits = [t for t in seen if t.is_hit]
                    ratios = [t.ratio() for t in hits if t.bound_mm2]
                    row.append(f"{percent(len(hits), len(seen))}, "
                               f"{figure(root_mean_square(ratios)) if ratios else '–'}")
                rows.append(row)
    table(["before", "condition"] + [f"`{d}`" for d in DETECTORS], rows)


def covariances(trials):
    print("## Covariances\n")
    rows = []
    for facade in ("painted", "plain", "street"):
        row = [facade]
        for detector in DETECTORS:
            squares = [t.normalised_square for t in trials
                       if t.facade == facade and "calibrated" not in t.part
                       and t.detector == detector and t.is_hit and t.covariance_m2]
            within = sum(s <= CHI2_OF_3_AT_95_PERCENT for s in squares)
            row.append(f"{percent(within, len(squares))} % of {len(squares)}, "
                       f"{figure(statistics.median(squares)) if squares else '–'}")
        rows.append(row)
    table(["before"] + [f"`{d}`" for d in DETECTORS], rows)


def goal_rows(trials, alarms):
    def share(what, limit, goal_is_least, chosen, is_counted):
        k, n = sum(map(is_counted, chosen)), len(chosen)
        lower, upper = clopper_pearson(k, n, 0.025 if goal_is_least else 0.05)
        met = lower >= limit if goal_is_least else upper <= limit
        missed = upper < limit if goal_is_least else lower > limit
        sign = "≥" if goal_is_least else "<"
        digits = 2 if goal_is_least else 3
        yield [what, f"{sign} {100.0 * limit:g} %", str(n), f"{100.0 * k / n:.{digits}f} %",
               (f"{100.0 * lower:.{digits}f} – {100.0 * upper:.{digits}f} %" if goal_is_least
                else f"up to {100.0 * upper:.{digits}f} %"),
               "met" if met else "missed" if missed else "undecided"]

    def ratio(what, limit, chosen):
        values = [t.ratio() for t in chosen if t.is_hit and t.bound_mm2]
        value, (lower, upper) = root_mean_square(values), bootstrap(values)
        verdict = ("" if limit is None else "met" if upper <= limit
                   else "missed" if lower > limit else "undecided")
        near = [v for v in values if v < FAR]
        far = len(values) - len(near)
        rest = f" ({far} above {FAR:g}, {root_mean_square(near):.2f} without)" if far else ""
        yield [what, "–" if limit is None else f"≤ {limit:g}", str(len(values)),
               f"{value:.2f}{rest}", f"{lower:.2f} – {upper:.2f}", verdict]

    seen = [t for t in trials if t.in_view]
    exact = [t for t in seen if "calibrated" not in t.part]
    edge = [t for t in exact if t.detector == "edge-stereo"]
    plane = [t for t in seen if t.detector == "plane-rgbd"]
    within = [t for t in edge if t.distance_m <= 8.0 and t.levels.get("azimuth_deg", 0.0) <= 40.0]
    yield from share("`edge-stereo`: hits within 8 m and 40°", 0.99, True, within,
                     lambda t: t.is_hit)
    for facade in ("painted", "plain", "street"):
        yield from share(f"– {facade}", 0.99, True, [t for t in within if t.facade == facade],
                         lambda t: t.is_hit)
    yield from ratio("`edge-stereo`: RMSE / bound, nothing hidden", 1.5,
                     [t for t in edge if t.facade != "street"])
    for facade in ("painted", "plain"):
        yield from ratio(f"– {facade}", 1.5, [t for t in edge if t.facade == facade])
    yield from ratio("`plane-rgbd`: RMSE / bound, 1.2 to 3.5 m, nothing hidden", 2.0,
                     [t for t in plane if t.facade != "street"])
    for facade in ("painted", "plain"):
        yield from ratio(f"– {facade}", 2.0, [t for t in plane if t.facade == facade])
    for part in ("painted-calibrated", "street-calibrated"):
        yield from ratio(f"`edge-stereo`, {part}: RMSE / bound", None,
                         [t for t in seen if t.part == part and t.detector == "edge-stereo"])
    yield from ratio("`edge-stereo`, street, true calibration: RMSE / bound", None,
                     [t for t in edge if t.facade == "street"])
    yield from ratio("`plane-rgbd`, street: RMSE / bound", None,
                     [t for t in plane if t.facade == "street"])
    for name in DETECTORS:
        yield from share(f"`{name}`: gross errors", 0.001, False,
                         [t for t in seen if t.detector == name], lambda t: t.outcome == "gross")
    for name in DETECTORS:
        yield from share(f"`{name}`: false alarms, a frame without a window", 0.001, False,
                         [t for t in alarms if t.detector == name],
                         lambda t: t.outcome == "false_alarm")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    trials, alarms = map(read, sys.argv[1:])
    by_distance(trials, "Stereo", DETECTORS[:2])
    by_distance(trials, "RGB-D", DETECTORS[2:])
    by_condition(trials)
    covariances(trials)
    print("## Goals\n")
    table(["figure", "goal", "of", "value", "95 % interval", ""], goal_rows(trials, alarms))


if __name__ == "__main__":
    main()
