"""A glTF file of Fenestra's in Blender's Cycles, with the light and the shading that both know.

Runs in Blender's Python. 1 lux is 1 unit of irradiance, so radiance comes out in cd/m².
"""

import math
import warnings

import bpy
import mathutils
import numpy

# Blender 3.4's glTF importer says numpy.bool, which numpy 1.24 no longer has.
with warnings.catch_warnings():
    warnings.simplefilter("ignore", FutureWarning)
    if not hasattr(numpy, "bool"):
        numpy.bool = bool


def load(glb, camera, object_names):
    """Fills Blender's scene from the file; pass indices count the named objects from 1."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=glb)
    for lamp in [o for o in bpy.data.objects if o.type == "LIGHT"]:
        bpy.data.objects.remove(lamp)
    for material in bpy.data.materials:
        _make_lambert(material)
    for index, name in enumerate(object_names):
        bpy.data.objects[name].pass_index = index + 1
    scene = bpy.context.scene
    scene.camera = bpy.data.objects[camera]
    intrinsics = scene.camera.data["fenestra"]
    scene.render.resolution_x = int(intrinsics["width_px"])
    scene.render.resolution_y = int(intrinsics["height_px"])
    scene.render.resolution_percentage = 100
    return scene


def _make_lambert(material):
    """Whatever colours the imported surface colours a diffuse one, without gloss."""
    tree = material.node_tree
    imported = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    if imported.inputs["Alpha"].is_linked or material.blend_method != "OPAQUE":
        raise ValueError(f"material {material.name} is not opaque: not covered by this comparison")
    for node in tree.nodes:
        if node.type == "TEX_IMAGE":
            node.image = _linear(node.image)
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Roughness"].default_value = 0.0  # Lambert; above 0 it would be Oren-Nayar.
    diffuse.inputs["Color"].default_value = imported.inputs["Base Color"].default_value
    for link in imported.inputs["Base Color"].links:
        tree.links.new(link.from_socket, diffuse.inputs["Color"])
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])


def _linear(image):
    """The image with linear values, since Cycles interpolates 8-bit ones as they are encoded."""
    encoded = numpy.empty(image.size[0] * image.size[1] * 4, dtype=numpy.float32)
    image.pixels.foreach_get(encoded)
    encoded = encoded.reshape(-1, 4)
    color = encoded[:, :3]
    encoded[:, :3] = numpy.where(
        color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4
    )
    linear = bpy.data.images.new(
        image.name + " linear", image.size[0], image.size[1], float_buffer=True
    )
    linear.colorspace_settings.name = "Non-Color"
    linear.pixels.foreach_set(encoded.ravel())
    linear.update()
    return linear


def add_sun(scene, light):
    """The sun's disc. Blender's z axis is up; glTF's (x, y, z) is its (x, -z, y)."""
    if light["sun_lx"] == 0:
        return
    azimuth = math.radians(light["sun_azimuth_deg"])
    elevation = math.radians(light["sun_elevation_deg"])
    to_sun = mathutils.Vector(
        (
            math.cos(elevation) * math.sin(azimuth),
            -math.cos(elevation) * math.cos(azimuth),
            math.sin(elevation),
        )
    )
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.energy = light["sun_lx"]
    lamp.angle = 9.3e-3  # As scenes/lighting.h has it.
    sun = bpy.data.objects.new("sun", lamp)
    sun.rotation_euler = to_sun.to_track_quat("Z", "Y").to_euler()  # Lamps shine along their -z.
    scene.collection.objects.link(sun)


def add_portals(scene):
    """Tells Cycles where the sky's light enters rooms. Alters the noise there, not the result."""
    for window in [o for o in bpy.data.objects if "fenestra" in o]:
        extras = window["fenestra"]
        size = extras.get("target_window") or extras.get("other_window")
        if not size:
            continue
        lamp = bpy.data.lights.new("portal", "AREA")
        lamp.shape = "RECTANGLE"
        lamp.size = size["width_m"]
        lamp.size_y = size["height_m"]
        lamp.cycles.is_portal = True
        portal = bpy.data.objects.new("portal", lamp)
        # Lamps shine along -z; into the wall is the +y of an imported window's axes.
        portal.matrix_world = window.matrix_world @ mathutils.Matrix.Rotation(math.pi / 2, 4, "X")
        scene.collection.objects.link(portal)


def add_sky(scene, light):
    """L = horizon + (zenith - horizon) sin γ above the horizon, and a uniform ground below it."""
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    direction = nodes.new("ShaderNodeTexCoord")
    split = nodes.new("ShaderNodeSeparateXYZ")
    links.new(direction.outputs["Generated"], split.inputs[0])

    def math_node(operation, *operands):
        node = nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, operand in zip(node.inputs, operands):
            if isinstance(operand, (int, float)):
                socket.default_value = operand
            else:
                links.new(operand, socket)
        return node.outputs[0]

    z = split.outputs["Z"]
    sky = math_node("MULTIPLY_ADD", z, light["zenith"] - light["horizon"], light["horizon"])
    above = math_node("GREATER_THAN", z, 0.0)
    difference = math_node("SUBTRACT", sky, light["ground"])
    strength = math_node("MULTIPLY_ADD", above, difference, light["ground"])
    links.new(strength, nodes["Background"].inputs["Strength"])
    nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)


def set_up_cycles(scene, samples, bounces, seed=0):
    """Path tracing without anything that trades truth for calm pictures."""
    scene.render.engine = "CYCLES"
    scene.view_settings.view_transform = "Raw"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.seed = seed
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = 0.0
    cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.max_bounces = bounces
    cycles.diffuse_bounces = bounces
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0  # The mean over the pixel's area, as in Fenestra.
