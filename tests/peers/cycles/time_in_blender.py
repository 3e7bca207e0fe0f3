"""blender -b --python-exit-code 1 --python time_in_blender.py -- THREADS JOB.json...

Prints how long Cycles takes for one 752 x 480 frame at 4 samples a pixel, of jobs that compare.py
left: wall clock and processor time, medians of five frames after a first one that is not counted.
Ray tracing structures are kept from frame to frame, as Fenestra keeps its own; what remains beside
rendering is Blender's own overhead.
"""

import json
import os
import pathlib
import statistics
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import blender_scene  # noqa: E402
import bpy  # noqa: E402

FRAMES = 5


def time_frame():
    wall, cpu = time.perf_counter(), time.process_time()
    bpy.ops.render.render()
    return time.perf_counter() - wall, time.process_time() - cpu


def time_job(file, threads):
    job = json.loads(file.read_text(encoding="utf-8"))
    scene = blender_scene.load(job["glb"], job["camera"], job["objects"])
    blender_scene.add_sun(scene, job["light"])
    blender_scene.add_sky(scene, job["light"])
    scene.render.resolution_x, scene.render.resolution_y = 752, 480
    scene.render.use_persistent_data = True
    scene.render.threads_mode = "FIXED"
    scene.render.threads = threads
    for bounces in (0, 16):
        blender_scene.set_up_cycles(scene, samples=4, bounces=bounces)
        times = [time_frame() for _ in range(FRAMES + 1)][1:]
        wall, cpu = (1e3 * statistics.median(column) for column in zip(*times))
        print(f"TIME {file.stem}: {bounces} bounces: {wall:.0f} ms, processor {cpu:.0f} ms")


arguments = sys.argv[sys.argv.index("--") + 1 :]
for name in arguments[1:]:
    time_job(pathlib.Path(name), int(arguments[0]))
