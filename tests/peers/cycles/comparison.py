"""What the images of two renderers have in common, in figures."""

import dataclasses

import images
import numpy as np

BLOCK_PX = 8  # Radiance is compared by means over blocks: Cycles' noise falls to an eighth.
LEAST_PIXELS = 16  # Of one surface in a block; with fewer the block is left out.
LEAST_BLOCKS = 5  # Of a surface; with fewer there is no figure for it.


@dataclasses.dataclass
class Depth:
    pixels: int
    p999_mm: float
    max_mm: float
    same_object: float  # Share of the pixels that see the same object.


@dataclasses.dataclass
class Surface:
    name: str
    blocks: int
    mean: float  # Theirs over ours - 1, of the sums over all blocks and colours.
    mean_noise: float  # Standard deviation of that, from what two seeds of Cycles differ.
    median: float  # Of |theirs over ours - 1| over blocks and colours.
    p95: float
    noise: float  # Median of what two seeds differ in a block, as noise of their mean.

    def agrees(self, most_error):
        """Whether mean and median are within the error; noise alone condemns neither."""
        mean_agrees = abs(self.mean) <= most_error + 3.0 * self.mean_noise
        return mean_agrees and (self.median <= most_error or self.is_noisy(most_error))

    def is_noisy(self, most_error):
        """Whether too noisy for its median to be judged."""
        return self.noise > most_error / 4.0


def compare_depth(ours, theirs):
    valid = images.smooth_depth(ours)
    error_mm = 1e3 * np.abs(ours["depth.Z"] - theirs["Depth.Z"])[valid]
    same = ours["object.ID"][valid] + 1 == np.round(theirs["IndexOB.X"][valid])
    return Depth(
        int(valid.sum()), np.percentile(error_mm, 99.9), error_mm.max(), float(same.mean())
    )


def _block_sums(values):
    height, width = (n // BLOCK_PX * BLOCK_PX for n in values.shape[:2])
    cropped = values[:height, :width]
    shape = (height // BLOCK_PX, BLOCK_PX, width // BLOCK_PX, BLOCK_PX, *values.shape[2:])
    return cropped.reshape(shape).sum(axis=(1, 3))


def _compare_surface(name, mask, ours, seeds):
    enough = _block_sums(mask.astype(int)) >= LEAST_PIXELS
    if enough.sum() < LEAST_BLOCKS:
        return None
    mean = lambda light: _block_sums(light * mask[:, :, None])[enough]
    reference = mean(ours)
    first, second = (mean(light) for light in seeds)
    theirs = 0.5 * (first + second)
    relative = theirs / reference - 1.0
    deviation = 0.5 * np.abs(first - second)
    noise = deviation / reference
    return Surface(
        name,
        int(enough.sum()),
        theirs.sum() / reference.sum() - 1.0,
        # A colour's noise is that of the others too, as all come from the same paths.
        np.sqrt((deviation.sum(axis=1) ** 2).sum()) / reference.sum(),
        np.median(np.abs(relative)),
        np.percentile(np.abs(relative), 95),
        np.median(noise),
    )


def compare_radiance(ours, seeds, object_names):
    """One row for the faces of each object along the wall and one for its other faces."""
    valid = images.smooth_light(ours)
    front = images.facing(ours)
    our_light = images.stack(ours, "", "RGB")
    their_light = [images.stack(seed, "Combined.", "RGB") for seed in seeds]
    rows = []
    for index, name in enumerate(object_names):
        of_object = valid & (ours["object.ID"] == index)
        for faces, mask in (("front", of_object & front), ("sides", of_object & ~front)):
            rows.append(_compare_surface(f"{name}, {faces}", mask, our_light, their_light))
    return [row for row in rows if row]
