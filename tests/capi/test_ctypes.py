"""The C API by ctypes, as foreign languages call it: bakes, looks up, and traces a grid in libfiligree.so."""

import ctypes
import os
import unittest
from ctypes import byref, c_char, c_double, c_float, c_size_t, c_uint8, c_uint32, c_void_p

OK, ARGUMENT = 0, 1
TRANSPARENT, OPAQUE = 0, 1
NO_GRID = 0xFFFFFFFF

library = ctypes.CDLL(os.environ["FILIGREE_LIBRARY"])


class ErrorInfo(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("code", c_uint32), ("message", c_char * 500)]


class Image(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("texels", c_void_p), ("width", c_uint32), ("height", c_uint32),
                ("texel", c_uint32), ("wrap_u", c_uint32), ("wrap_v", c_uint32), ("filter", c_uint32),
                ("texel_stride", c_size_t), ("row_stride", c_size_t)]


class Triangles(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("triangle_count", c_size_t), ("uvs", c_void_p), ("uv_stride", c_size_t),
                ("indices", c_void_p), ("index_bytes", c_uint32), ("reserved", c_uint32), ("vertex_count", c_size_t),
                ("triangle_stride", c_size_t), ("vertex_alpha", c_void_p), ("vertex_alpha_stride", c_size_t),
                ("positions", c_void_p), ("position_stride", c_size_t)]


class Heightfield(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("heights", c_void_p), ("columns", c_uint32), ("rows", c_uint32),
                ("type", c_uint32), ("reserved", c_uint32), ("height_stride", c_size_t), ("row_stride", c_size_t),
                ("cell", c_double), ("height_scale", c_double)]


class Ray(ctypes.Structure):
    _fields_ = [("origin", c_float * 3), ("direction", c_float * 3), ("t_min", c_float), ("t_max", c_float)]


class Hit(ctypes.Structure):
    _fields_ = [("t", c_float), ("grid", c_uint32), ("column", c_uint32), ("row", c_uint32), ("half", c_uint32),
                ("u", c_float), ("v", c_float), ("normal", c_float * 3), ("source", c_uint32)]


def initialised(struct, init):
    """A struct with the defaults that the library sets."""
    value = struct()
    assert init(byref(value), c_size_t(ctypes.sizeof(value))) == OK
    assert value.struct_size == ctypes.sizeof(value)
    return value


class Ctypes(unittest.TestCase):
    def setUp(self):
        self.error = ErrorInfo(struct_size=ctypes.sizeof(ErrorInfo))

    def call(self, function, *arguments):
        """Calls with the error info last, and raises what went wrong."""
        if function(*arguments, byref(self.error)) != OK:
            raise RuntimeError(self.error.message.decode())

    def bake(self):
        """A disc of alpha under two triangles; the second list of coordinates is kept alive by the caller."""
        side = 32
        texels = (c_uint8 * (side * side))(*(255 if (x - 12) ** 2 + (y - 16) ** 2 < 100 else 0
                                             for y in range(side) for x in range(side)))
        uvs = (c_float * 12)(0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 1)
        image = initialised(Image, library.filigree_image_init)
        image.texels, image.width, image.height = ctypes.addressof(texels), side, side
        triangles = initialised(Triangles, library.filigree_triangles_init)
        triangles.uvs, triangles.triangle_count = ctypes.addressof(uvs), 2
        maps = c_void_p()
        self.call(library.filigree_bake, None, byref(triangles), byref(image), None, None, None, byref(maps))
        return maps

    def test_version(self):
        library.filigree_version.restype = c_uint32
        library.filigree_error_name.restype = ctypes.c_char_p
        self.assertGreaterEqual(library.filigree_version(), 100)
        self.assertEqual(library.filigree_error_name(ARGUMENT), b"FILIGREE_ERROR_ARGUMENT")

    def test_bake_and_lookup(self):
        maps, encoded = self.bake(), c_void_p()
        count = c_size_t()
        self.call(library.filigree_micromaps_get_data, maps, None, c_size_t(0), byref(count))
        self.assertGreater(count.value, 0)
        data = (c_uint8 * count.value)()
        self.call(library.filigree_micromaps_get_data, maps, data, count, byref(count))
        self.assertTrue(any(data))
        self.call(library.filigree_encode, None, maps, None, None, byref(encoded))
        library.filigree_micromaps_destroy(maps)

        points = [(0.0, 0.0), (0.375, 0.5), (0.4, 0.5)]
        maps_of = (c_uint32 * 3)(0, 0, 0)
        u, v = (c_float * 3)(*(p[0] for p in points)), (c_float * 3)(*(p[1] for p in points))
        states = (c_uint8 * 3)()
        self.call(library.filigree_set_lookup, encoded, c_size_t(3), maps_of, u, v, states)
        self.assertEqual(list(states), [TRANSPARENT, OPAQUE, OPAQUE])
        for k, (x, y) in enumerate(points):
            self.assertEqual(library.filigree_set_triangle_state(encoded, c_size_t(0), c_float(x), c_float(y)),
                             states[k])
        library.filigree_set_destroy(encoded)

    def test_errors(self):
        maps = c_void_p()
        with self.assertRaisesRegex(RuntimeError, "triangles: is NULL"):
            self.call(library.filigree_bake, None, None, None, None, None, None, byref(maps))
        self.assertEqual(self.error.code, ARGUMENT)
        self.assertIsNone(maps.value)

    def test_trace_a_grid(self):
        side = 17
        heights = (c_float * (side * side))(*(0.1 * (k % 5) for k in range(side * side)))
        field = initialised(Heightfield, library.filigree_heightfield_init)
        field.heights, field.columns, field.rows, field.type = ctypes.addressof(heights), side, side, 2
        grids, tracer = c_void_p(), c_void_p()
        self.call(library.filigree_grids_create_from_heights, None, byref(field), None, None, byref(grids))
        self.call(library.filigree_tracer_create, None, grids, byref(tracer))
        rays = (Ray * 2)(Ray((4.3, 10, 7.2), (0, -1, 0), 0, 100), Ray((-1, 10, 7.2), (0, -1, 0), 0, 100))
        hits = (Hit * 2)()
        self.call(library.filigree_tracer_closest, tracer, c_size_t(2), rays, c_size_t(0), hits, c_size_t(0))
        self.assertEqual((hits[0].grid, hits[0].column, hits[0].row), (0, 4, 7))
        self.assertTrue(9.5 < hits[0].t < 10.01)
        self.assertEqual(hits[1].grid, NO_GRID)
        library.filigree_tracer_destroy(tracer)
        library.filigree_grids_destroy(grids)


# Handles are pointers: ctypes would cut them to int otherwise.
for name in ("micromaps", "set", "grids", "tracer"):
    getattr(library, f"filigree_{name}_destroy").argtypes = [c_void_p]
    getattr(library, f"filigree_{name}_destroy").restype = None
library.filigree_set_triangle_state.argtypes = [c_void_p, c_size_t, c_float, c_float]

if __name__ == "__main__":
    unittest.main()
