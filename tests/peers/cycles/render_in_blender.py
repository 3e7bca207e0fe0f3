"""blender -b --factory-startup --python-exit-code 1 --python render_in_blender.py -- JOB.json

Writes OUT_truth.exr (depth, normal and object at pixel centres) and, for each seed, OUT_SEED.exr
(radiance). The job is what compare.py writes.
"""

import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import blender_scene  # noqa: E402
import bpy  # noqa: E402


def write_exr(scene, path):
    settings = scene.render.image_settings
    settings.file_format = "OPEN_EXR_MULTILAYER"
    settings.color_depth = "32"
    settings.exr_codec = "ZIP"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        job = json.load(file)
    scene = blender_scene.load(job["glb"], job["camera"], job["objects"])
    blender_scene.add_sun(scene, job["light"])
    blender_scene.add_sky(scene, job["light"])
    blender_scene.add_portals(scene)

    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_object_index = True
    blender_scene.set_up_cycles(scene, samples=1, bounces=0)
    scene.cycles.filter_width = 0.01  # The pixel's centre, or as near as Cycles lets come.
    write_exr(scene, job["out"] + "_truth.exr")

    for seed in job["seeds"]:
        blender_scene.set_up_cycles(scene, job["samples"], job["bounces"], seed)
        write_exr(scene, f"{job['out']}_{seed}.exr")


main()
