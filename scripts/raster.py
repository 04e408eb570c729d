# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values on material points as a picture.

Each pixel takes the value of the material point that is nearest by the measure
of the point's own size, as long as it is no farther than this size: so fine
and coarse points both cover their area, and a void stays empty.
"""
import numpy as np

PIXELS = 500  # over the radius, or over half the height if that is more


def sizes(points):
    """The side of the square that each point stands for, m."""
    if "volume" in points:
        area = points["volume"] / np.maximum(points["position"][:, 0], 1e-12)
        return np.sqrt(np.maximum(area, 0))
    extent = np.ptp(points["position"], axis=0)
    return np.full(len(points["position"]),
                   np.sqrt(np.prod(extent) / len(points["position"])))


def covered(position, size, spacing, shape):
    """(pixel, distance / size) [n_points, n] of the pixels about points of
    like size; outside the picture the ratio is infinite."""
    reach = int(np.ceil(size.max() / spacing))
    offset = np.arange(-reach, reach + 1)
    base = np.floor(position / spacing).astype(int)
    column = base[:, 0, None, None] + offset[None, None, :]
    row = base[:, 1, None, None] + offset[None, :, None]
    ratio = np.hypot((column + 0.5) * spacing - position[:, 0, None, None],
                     (row + 0.5) * spacing - position[:, 1, None, None])
    ratio /= size[:, None, None]
    inside = ((column >= 0) & (column < shape[1]) &
              (row >= 0) & (row < shape[0]))
    return row * shape[1] + column, np.where(inside, ratio, np.inf)


def nearest_by_size(position, size, spacing, shape):
    """For each pixel [rows, columns] the index of the point of the least
    distance / size below 1, or -1. The lower left corner is the origin."""
    size = np.maximum(size, spacing)
    octave = np.ceil(np.log2(size))
    found = []
    for group in (np.flatnonzero(octave == o) for o in np.unique(octave)):
        pixel, ratio = covered(position[group], size[group], spacing, shape)
        point = np.broadcast_to(group[:, None, None], ratio.shape)
        near = ratio < 1
        found.append((pixel[near], ratio[near], point[near]))
    pixel, ratio, point = [np.concatenate(parts) for parts in zip(*found)]
    order = np.argsort(-ratio)  # the nearest is written last
    best = np.full(shape, -1)
    best.flat[pixel[order]] = point[order]
    return best


def raster(points, values, window):
    """The values on pixels (void: nan), mirrored on the axis, and their extent;
    the window is (radius, bottom, top)."""
    radius, bottom, top = window
    spacing = max(radius, (top - bottom) / 2) / PIXELS
    shape = tuple(np.ceil([(top - bottom) / spacing,
                           radius / spacing]).astype(int))
    position, size = points["position"] - [0, bottom], sizes(points)
    near = np.flatnonzero((position[:, 0] < radius + size) &
                          (position[:, 1] > -size) &
                          (position[:, 1] < top - bottom + size))
    best = nearest_by_size(position[near], size[near], spacing, shape)
    half = np.full(shape, np.nan)
    half[best >= 0] = values[near][best[best >= 0]]
    return (np.concatenate([half[:, ::-1], half], axis=1),
            spacing * np.array([-shape[1], shape[1], 0, shape[0]]) +
            [0, 0, bottom, bottom])
