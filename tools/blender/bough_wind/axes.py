"""Blender's axes (z up) and bough's (y up), and rotations of many bodies at once."""
import numpy as np

# Rows: bough's x, y, z of Blender's.
TO_BOUGH = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])


def matrices(quaternions):
    """(n, 3, 3) of (n, 4) x, y, z, w of unit length."""
    x, y, z, w = np.asarray(quaternions, float).T
    return np.stack([
        np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
        np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], -1),
        np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1)], -2)


def quaternions(rotations):
    """(n, 4) w, x, y, z, as Blender has them, of (n, 3, 3): by the largest of the four (Shepperd)."""
    m = np.asarray(rotations, float)
    trace = np.trace(m, axis1=1, axis2=2)
    squares = np.stack([trace, m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]], 1)
    found = np.empty((len(m), 4))
    for k, largest in enumerate(np.argmax(squares, 1)):
        r = m[k]
        if largest == 0:
            q = [1 + trace[k], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]
        else:
            i = largest - 1
            j, l = (i + 1) % 3, (i + 2) % 3
            q = np.empty(4)
            q[0] = r[l, j] - r[j, l]
            q[1 + i] = 1 + r[i, i] - r[j, j] - r[l, l]
            q[1 + j] = r[j, i] + r[i, j]
            q[1 + l] = r[l, i] + r[i, l]
        found[k] = q
    return found / np.linalg.norm(found, axis=1)[:, None]


class Places:
    """An object's own coordinates and bough's: metres, the world's axes turned. Sizes of what is scaled unevenly go by the cube root of its volume."""

    def __init__(self, matrix_world, unit):
        matrix = np.array(matrix_world, float)
        self.forth = unit * TO_BOUGH @ matrix[:3, :3]
        self.origin = unit * TO_BOUGH @ matrix[:3, 3]
        self.back = np.linalg.inv(self.forth)
        self.scale = abs(np.linalg.det(self.forth)) ** (1 / 3)

    def to_bough(self, points):
        return points @ self.forth.T + self.origin

    def from_bough(self, points):
        return (points - self.origin) @ self.back.T
