#!/usr/bin/python3
"""Reads fixtures (docs/fixtures.md) and draws the truth over what the sensors saw.

    fenestra fixtures paper --out fixtures
    examples/python/read_fixtures.py fixtures pictures

For each trial of the bundle: the right or the colour image with the target's true outline, and by
how many pixels the calibration that detectors are told misses its corners there; with a depth camera
also by how much its points on the target's border are off in depth. Needs Debian's python3-opencv.
"""

import hashlib
import json
import pathlib
import sys

import cv2
import numpy as np


def check_files(root, manifest):
    """Ends the program if a file is not the one that was written."""
    for file in manifest["files"]:
        if hashlib.sha256((root / file["path"]).read_bytes()).hexdigest() != file["sha256"]:
            sys.exit(f"{root / file['path']}: is not the file that was written")


def read_calibration(path, names):
    """The named matrices of a calibration.yaml."""
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    return [storage.getNode(name).mat() for name in names]


def read_cloud(path):
    """The points of a PCD file with binary x, y, z."""
    header, _, body = path.read_bytes().partition(b"DATA binary\n")
    count = int(header.split(b"POINTS ")[1].split()[0])
    return np.frombuffer(body, dtype="<f4", count=3 * count).reshape(-1, 3)


def depth_error_m(points, target):
    """Median distance, in depth, of a cloud's points on the target's border from its plane."""
    centroid, normal = np.array(target["centroid_m"]), np.array(target["normal"])
    top_left, top_right, _, bottom_left = np.array(target["corners_m"])
    right = (top_right - top_left) / target["width_m"]
    down = (bottom_left - top_left) / target["height_m"]
    depth_on_plane = (normal @ centroid) / (points @ normal) * points[:, 2]
    on_plane = points * (depth_on_plane / points[:, 2])[:, None] - centroid
    # Within 4 cm of the outer rectangle, which every border is wide.
    x = target["width_m"] / 2 - np.abs(on_plane @ right)
    y = target["height_m"] / 2 - np.abs(on_plane @ down)
    border = (np.minimum(x, y) > 0.01) & (np.minimum(x, y) < 0.04)
    if not border.any():
        return float("nan")
    return float(np.median(points[border, 2] - depth_on_plane[border]))


def show(root, trial, out):
    observation, truth_folder = root / trial["observation"], root / trial["truth"]
    truth = json.loads((truth_folder / "truth.json").read_text())
    name = f"{trial['cell']}/{trial['trial']} {trial['sensor']}"
    target = truth["target"]
    if target is None:
        print(f"{name}: no window")
        return
    stereo = trial["sensor"] == "stereo"
    # The windows are in the left camera's frame, or in the depth camera's.
    camera = "right" if stereo else "color"
    picture = cv2.imread(str(observation / f"{camera}.png"))
    K, D, R, T = read_calibration(
        observation / "calibration.yaml",
        ("K2", "D2", "R", "T") if stereo else ("K_color", "D_color", "R", "T"))
    corners = np.array(target["corners_m"])
    told = cv2.projectPoints(corners, cv2.Rodrigues(R)[0], T, K, D)[0].reshape(-1, 2)
    true = np.array(target["corners_px"][camera])
    error = np.linalg.norm(told - true, axis=1).max()
    line = f"{name}: {target['centroid_m'][2]:.3f} m ahead, told corners off by {error:.3f} px"
    if not stereo:
        points = read_cloud(observation / "cloud.pcd")
        line += f", depth off by {1e3 * depth_error_m(points, target):.1f} mm"
    print(line)
    outline = np.round(16 * true).astype(np.int32).reshape(-1, 1, 2)
    cv2.polylines(picture, [outline], True, (0, 255, 0), 1, cv2.LINE_AA, shift=4)
    cv2.imwrite(str(out / (pathlib.Path(trial["truth"]).parent.name + ".png")), picture)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    root, out = map(pathlib.Path, sys.argv[1:])
    manifest = json.loads((root / "manifest.json").read_text())
    check_files(root, manifest)
    out.mkdir(parents=True, exist_ok=True)
    print(f"{manifest['study']}, seed {manifest['seed']}, Fenestra {manifest['fenestra_version']}")
    for trial in manifest["trials"]:
        if "observation" in trial:
            show(root, trial, out)


if __name__ == "__main__":
    main()
