#!/usr/bin/python3
"""Renders the same glTF files with Fenestra and with Blender's Cycles, and compares.

Exits 0 if they agree, 1 if not, 77 (skipped) if Blender or a Python module of Debian's is missing.
"""

import argparse
import json
import math
import pathlib
import shutil
import struct
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SKIPPED = 77
GROUND_REFLECTANCE = 0.2  # Fenestra's default.
MOST_DEPTH_ERROR_MM = 1.0
MOST_RADIANCE_ERROR = 0.02

# One lighting for each study of the folder beside.
CASES = {
    "painted": dict(sky="uniform", sky_lx=10e3, sun_lx=60e3, azimuth_deg=30, elevation_deg=40),
    "window": dict(sky="uniform", sky_lx=10e3, sun_lx=60e3, azimuth_deg=30, elevation_deg=40),
    "brick": dict(sky="cie_overcast", sky_lx=12e3, sun_lx=0, azimuth_deg=0, elevation_deg=40),
    "street": dict(sky="uniform", sky_lx=12e3, sun_lx=50e3, azimuth_deg=50, elevation_deg=20),
}


def skip_unless_possible():
    if not shutil.which("blender"):
        print("SKIPPED: blender is not installed")
        sys.exit(SKIPPED)
    try:
        import numpy  # noqa: F401
        import OpenImageIO  # noqa: F401
    except ImportError as error:
        print(f"SKIPPED: {error.name} is not installed for {sys.executable}")
        sys.exit(SKIPPED)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fenestra", required=True, help="the program")
    parser.add_argument("--out", required=True, type=pathlib.Path, help="folder for all images")
    parser.add_argument("--samples", type=int, default=512, help="of Cycles, per pixel and seed")
    parser.add_argument("--reuse", action="store_true",
                        help="take Cycles' images of the same jobs that --out has")
    parser.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES))
    return parser.parse_args()


def blender_light(light):
    """The radiances [cd/m²] of SkyDome (scenes/sky_dome.h) and of the ground below the horizon."""
    sun_on_ground_lx = light["sun_lx"] * math.sin(math.radians(light["elevation_deg"]))
    if light["sky"] == "uniform":
        horizon = zenith = light["sky_lx"] / math.pi
    else:
        zenith = 9.0 / (7.0 * math.pi) * light["sky_lx"]
        horizon = zenith / 3.0
    return {
        "horizon": horizon,
        "zenith": zenith,
        "ground": GROUND_REFLECTANCE * (light["sky_lx"] + sun_on_ground_lx) / math.pi,
        "sun_lx": light["sun_lx"],
        "sun_azimuth_deg": light["azimuth_deg"],
        "sun_elevation_deg": light["elevation_deg"],
    }


def object_names(glb):
    """Of a .glb of Fenestra's, in the order of the object ids: one mesh for each node."""
    data = glb.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20 : 20 + length])
    return [node["name"] for node in document["nodes"] if "mesh" in node]


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")


def render_with_fenestra(fenestra, name, light, out):
    glb = out / f"{name}.glb"
    run(fenestra, "export", HERE / "studies" / f"{name}.yaml", "--out", glb)
    sky = ("--sky", light["sky"], "--sky-lx", light["sky_lx"])
    sun = ("--sun-azimuth-deg", light["azimuth_deg"], "--sun-elevation-deg", light["elevation_deg"])
    sun = ("--sun-lx", light["sun_lx"], *sun)
    run(fenestra, "render", glb, "--camera", "left", *sky, *sun, "--out", out / name)
    return glb, out / name / "left" / "scene.exr"


def render_with_cycles(glb, name, light, arguments):
    out = arguments.out
    job = {
        "glb": str(glb),
        "camera": "left",
        "objects": object_names(glb),
        "out": str(out / f"{name}_cycles"),
        "samples": arguments.samples,
        "bounces": 16,  # As many as Fenestra's.
        "seeds": [1, 2],
        "light": blender_light(light),
    }
    file = out / f"{name}_job.json"
    text = json.dumps(job, indent=1)
    exrs = [f"{job['out']}_{what}.exr" for what in ("truth", *job["seeds"])]
    is_known = file.exists() and file.read_text(encoding="utf-8") == text
    if arguments.reuse and is_known and all(pathlib.Path(exr).exists() for exr in exrs):
        return exrs
    file.write_text(text, encoding="utf-8")
    script = HERE / "render_in_blender.py"
    blender = ("blender", "-b", "--factory-startup", "--python-exit-code", 1)
    run(*blender, "--python", script, "--", file)
    return exrs


def report(name, depth, surfaces):
    """Prints the figures; returns whether they are in bounds."""
    agree = depth.max_mm <= MOST_DEPTH_ERROR_MM and depth.same_object == 1.0
    print(
        f"{name}: depth of {depth.pixels} px: p99.9 {depth.p999_mm:.4f} mm, max "
        f"{depth.max_mm:.4f} mm; same object {100 * depth.same_object:.3f} %"
        f"{'' if agree else '   FAILED'}"
    )
    print(f"  {'radiance of':28}blocks    mean     ±    median     p95   noise   [%]")
    for s in surfaces:
        good = s.agrees(MOST_RADIANCE_ERROR)
        agree &= good
        figures = "".join(f"{100 * x:8.2f}" for x in (s.mean, s.mean_noise, s.median, s.p95, s.noise))
        verdict = ("   noisy" if s.is_noisy(MOST_RADIANCE_ERROR) else "") if good else "   FAILED"
        print(f"  {s.name:28}{s.blocks:6}{figures}{verdict}")
    return agree


def compare_case(arguments, name):
    import comparison
    import images

    light = CASES[name]
    glb, exr = render_with_fenestra(arguments.fenestra, name, light, arguments.out)
    exrs = render_with_cycles(glb, name, light, arguments)
    ours, truth, *seeds = (images.read_exr(file) for file in (exr, *exrs))
    images.write_side_by_side(
        arguments.out / f"{name}.png",
        images.stack(ours, "", "RGB"),
        sum(images.stack(seed, "Combined.", "RGB") for seed in seeds) / len(seeds),
    )
    surfaces = comparison.compare_radiance(ours, seeds, object_names(glb))
    return report(name, comparison.compare_depth(ours, truth), surfaces)


def main():
    skip_unless_possible()
    arguments = parse_arguments()
    arguments.out.mkdir(parents=True, exist_ok=True)
    agree = [compare_case(arguments, name) for name in arguments.cases]
    sys.exit(0 if all(agree) else 1)


main()
