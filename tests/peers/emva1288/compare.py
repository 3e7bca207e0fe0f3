#!/usr/bin/python3
"""Takes an EMVA 1288 series with Fenestra and evaluates it with the open-source EMVA1288 package.

Exits 0 if the package finds what was put into the simulated camera, 1 if not, 77 (skipped) if the
package or a Python module that it needs is missing.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77

try:
    from emva1288.process.data import Data1288
    from emva1288.process.loader import LoadImageData
    from emva1288.process.parser import ParseEmvaDescriptorFile
    from emva1288.process.results import Results1288
except ImportError as error:
    print(f"SKIPPED: {error.name} is not installed for {sys.executable}")
    sys.exit(SKIPPED)

# Fenestra's figure, the package's, the largest relative departure from what was put in.
FIGURES = [
    ("system gain K", lambda r: r.K, 0.02),
    ("quantum efficiency", lambda r: r.QE, 0.02),
    ("temporal dark noise", lambda r: r.sigma_d, 0.05),
    ("saturation capacity", lambda r: r.u_e_sat, 0.03),
    ("DSNU", lambda r: r.DSNU1288, 0.10),
    ("PRNU", lambda r: r.PRNU1288, 0.10),
]


def evaluate(descriptor):
    parser = ParseEmvaDescriptorFile(str(descriptor), path=str(descriptor.parent))
    images = LoadImageData(parser.images)
    return Results1288(Data1288(images.data).data)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--fenestra", required=True, type=pathlib.Path)
    arguments.add_argument("--exposures", default="50")
    arguments.add_argument("--frames", default="40")
    arguments.add_argument("--width-px", default="376")
    arguments.add_argument("--height-px", default="240")
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [options.fenestra, "emva", folder, "--exposures", options.exposures, "--frames",
             options.frames, "--width-px", options.width_px, "--height-px", options.height_px],
            check=True, stdout=subprocess.DEVNULL)
        ours = {f["figure"]: f for f in
                json.loads((pathlib.Path(folder) / "results.json").read_text())["figures"]}
        theirs = evaluate(pathlib.Path(folder) / "emva1288.txt")
    failed = False
    print(f"{'figure':22} {'unit':5} {'put in':>10} {'Fenestra':>10} {'emva1288':>10}")
    for name, figure, tolerance in FIGURES:
        put_in = ours[name]["put_in"]
        value = float(figure(theirs))
        wrong = not abs(value / put_in - 1.0) <= tolerance
        failed |= wrong
        print(f"{name:22} {ours[name]['unit']:5} {put_in:10.4g} {ours[name]['measured']:10.4g} "
              f"{value:10.4g}{'  FAILED' if wrong else ''}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
