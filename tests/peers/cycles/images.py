"""Images of both renderers, and where in them the two may be compared."""

import json

import numpy as np
import OpenImageIO as oiio

BAND_PX = 2  # Left out on both sides of an edge.


def read_exr(path):
    """Channels by name; those of Blender's only view layer without its name."""
    file = oiio.ImageInput.open(str(path))
    if file is None:
        raise RuntimeError(f"{path}: {oiio.geterror()}")
    pixels = file.read_image(oiio.FLOAT)
    names = [name.removeprefix("ViewLayer.") for name in file.spec().channelnames]
    image = {name: np.asarray(pixels[:, :, i], float) for i, name in enumerate(names)}
    placed = file.spec().getattribute("world_from_camera")
    if placed:
        image["R_WC"] = np.array(json.loads(placed)["rotation"])
    return image


def stack(image, prefix, names):
    return np.stack([image[prefix + name] for name in names], axis=2)


def _grown(mask, radius):
    for axis in (0, 1):
        padded = np.pad(mask, radius, mode="edge")
        views = [np.roll(padded, shift, axis) for shift in range(-radius, radius + 1)]
        mask = np.any(views, axis=0)[radius:-radius, radius:-radius]
    return mask


def _changes(values, limit):
    """Where a value differs from that of the next pixel, on both sides of the change."""
    changed = np.zeros(values.shape[:2], bool)
    for axis in (0, 1):
        step = np.diff(values, axis=axis)
        step = np.abs(step).reshape(*step.shape[:2], -1).max(axis=2) > limit
        before = [(0, 0), (0, 0)]
        after = [(0, 0), (0, 0)]
        before[axis], after[axis] = (1, 0), (0, 1)
        changed |= np.pad(step, before) | np.pad(step, after)
    return changed


def _bends(inverse_depth):
    """Where 1/z departs from a plane's, in which it is linear, by more than 2 mm of depth."""
    bent = np.zeros(inverse_depth.shape, bool)
    for axis in (0, 1):
        second = np.abs(np.diff(inverse_depth, n=2, axis=axis))
        margin = [(0, 0), (0, 0)]
        margin[axis] = (1, 1)
        bent |= np.pad(second, margin) > 0.002 * inverse_depth**2
    return bent


def smooth_depth(fenestra):
    """Pixels that see a surface, away from the outlines of objects and from steps in depth."""
    depth = fenestra["depth.Z"]
    seen = np.isfinite(depth)
    inverse = np.where(seen, 1.0 / np.where(seen, depth, 1.0), 0.0)
    edges = ~seen | _changes(fenestra["object.ID"], 0.5) | _bends(inverse)
    return ~_grown(edges, BAND_PX)


def smooth_light(fenestra):
    """The same, away from creases (more than 10°) and from the borders of shadows."""
    normal = stack(fenestra, "normal.", "XYZ")
    edges = _changes(normal, np.sin(np.radians(10.0))) | _changes(fenestra["sun.V"], 0.5)
    return smooth_depth(fenestra) & ~_grown(edges, BAND_PX)


def facing(fenestra):
    """True where a surface looks along the wall's outward normal."""
    normal_W = stack(fenestra, "normal.", "XYZ") @ fenestra["R_WC"].T
    return normal_W[:, :, 2] > 0.99


def write_side_by_side(path, ours, theirs):
    """Both radiances on one scale, and their difference: black -20 %, grey 0, white +20 %."""
    white = np.percentile(ours, 99)
    encode = lambda light: np.clip(light / white, 0, 1) ** (1 / 2.2)
    difference = 0.5 + (theirs - ours) / np.maximum(ours, 1e-6) / 0.4
    picture = np.concatenate([encode(ours), encode(theirs), np.clip(difference, 0, 1)], axis=1)
    height, width, channels = picture.shape
    image = oiio.ImageBuf(oiio.ImageSpec(width, height, channels, oiio.UINT8))
    image.set_pixels(oiio.ROI(), np.ascontiguousarray(picture, np.float32))
    image.write(str(path))
