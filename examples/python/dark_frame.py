#!/usr/bin/python3
"""A detector in Python: the largest dark frame in the left image, its depth from the right one.

It shows how to speak with Fenestra; as a detector it is simple. Needs Debian's python3-opencv.

    detectors:
      - name: dark-frame
        command: [/usr/bin/python3, examples/python/dark_frame.py]
        sensor: stereo
        options: {threshold: 60}
"""

import json
import sys

import cv2
import numpy as np

PROTOCOL = 1


def read_calibration(path):
    """The rectification of a stereo pair; the file is one of OpenCV's FileStorage."""
    file = cv2.FileStorage(path, cv2.FILE_STORAGE_READ)
    size = (int(file.getNode("image_width").real()), int(file.getNode("image_height").real()))
    K1, D1, K2, D2, R, T = (file.getNode(name).mat() for name in ("K1", "D1", "K2", "D2", "R", "T"))
    R1, R2, P1, P2, _, _, _ = cv2.stereoRectify(K1, D1, K2, D2, size, R, T, alpha=-1)
    maps = [
        cv2.initUndistortRectifyMap(K, D, turn, P, size, cv2.CV_32FC1)
        for K, D, turn, P in ((K1, D1, R1, P1), (K2, D2, R2, P2))
    ]
    return {"maps": maps, "turn": R1, "P1": P1, "focal_x_baseline": -P2[0, 3]}


def dark_quadrilaterals(image, threshold):
    """Corners of dark four-sided outlines, the largest first: top left, then clockwise."""
    _, dark = cv2.threshold(image, threshold, 255, cv2.THRESH_BINARY_INV)
    outlines, _ = cv2.findContours(dark, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    found = []
    for outline in sorted(outlines, key=cv2.contourArea, reverse=True):
        if cv2.contourArea(outline) < 400:
            break
        corners = cv2.approxPolyDP(outline, 0.02 * cv2.arcLength(outline, True), True)
        if len(corners) != 4 or not cv2.isContourConvex(corners):
            continue
        points = np.float32(corners.reshape(4, 2))
        centre = points.mean(axis=0)
        angles = np.arctan2(points[:, 1] - centre[1], points[:, 0] - centre[0])
        points = points[np.argsort(angles)]
        points = np.roll(points, -int(np.argmin(points.sum(axis=1))), axis=0)
        window = ((4, 4), (-1, -1), (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 30, 0.01))
        found.append(cv2.cornerSubPix(image, points.reshape(-1, 1, 2), *window).reshape(4, 2))
    return found


class DarkFrame:
    def __init__(self, options):
        self.threshold = options.get("threshold", 60)
        self.calibration_text = None
        self.calibration = None

    def calibrate(self, path):
        """Rectification is computed again only if the calibration is another one."""
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if text != self.calibration_text:
            self.calibration = read_calibration(path)
            self.calibration_text = text

    def detect(self, request):
        self.calibrate(request["calibration"])
        images = [
            cv2.remap(cv2.imread(request[side], cv2.IMREAD_GRAYSCALE), *maps, cv2.INTER_LINEAR)
            for side, maps in zip(("left", "right"), self.calibration["maps"])
        ]
        lefts, rights = (dark_quadrilaterals(image, self.threshold) for image in images)
        for left in lefts:
            for right in rights:
                shift = left - right
                same_rows = np.abs(shift[:, 1]).max() < 3
                if same_rows and shift[:, 0].min() > 0.5:
                    return self.window(left, shift[:, 0])
        return {
            "outcome": "miss",
            "reason": "no_frame",
            "detail": f"{len(lefts)} dark outlines on the left, {len(rights)} on the right",
        }

    def window(self, left, disparity):
        """Corners by z = f b / d in the rectified camera, turned back to the unrectified one."""
        P1 = self.calibration["P1"]
        depth = self.calibration["focal_x_baseline"] / disparity
        x = (left[:, 0] - P1[0, 2]) / P1[0, 0] * depth
        y = (left[:, 1] - P1[1, 2]) / P1[1, 1] * depth
        corners = np.column_stack((x, y, depth)) @ self.calibration["turn"]
        return {
            "outcome": "window",
            "centroid_m": corners.mean(axis=0).tolist(),
            "corners_m": corners.tolist(),
        }


def main():
    detector = None
    for line in sys.stdin:
        request = json.loads(line)
        if request["request"] == "hello":
            if request["sensor"] != "stereo":
                answer = {"error": "this detector works on stereo images"}
            else:
                detector = DarkFrame(request["options"])
                answer = {"protocol": PROTOCOL}
        else:
            answer = {"id": request["id"], **detector.detect(request)}
        # One line, and at once: Fenestra waits for it.
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
