"""Micromaps of a GLB, read independently of the program: what the page says of a point is judged by this."""

import json
import struct

EXTENSION = "EXT_mesh_opacity_micromap"
CODES = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}
STATES = ["transparent", "opaque", "unknown-transparent", "unknown-opaque"]


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def barycentrics_to_index(u, v, level):
    """The function of VK_KHR_opacity_micromap, step by step, in single precision."""
    u, v = max(0.0, min(1.0, single(u))), max(0.0, min(1.0, single(v)))
    n = 1 << level
    fu, fv = single(u * n), single(v * n)
    iu, iv = int(fu), int(fv)
    uf, vf = single(fu - iu), single(fv - iv)
    iu, iv = min(iu, n - 1), min(iv, n - 1)
    if iu + iv >= n:
        iu -= iu + iv - n + 1
    iw = ~(iu + iv)
    if single(uf + vf) >= 1 and iu + iv < n - 1:
        iw -= 1
    mask = n - 1
    b0 = ~(iu ^ iw) & mask
    t = (iu ^ iv) & b0
    c = t
    for shift in (1, 2, 4, 8):
        c ^= c >> shift
    b1 = ((c ^ iu) & ~b0) | t
    return sum((((b0 >> k) & 1) << (2 * k)) | (((b1 >> k) & 1) << (2 * k + 1)) for k in range(level))


class Baked:
    def __init__(self, glb):
        length = struct.unpack_from("<I", glb, 12)[0]
        self.doc = json.loads(glb[20:20 + length])
        self.bin = glb[28 + length:]
        self.sets = self.doc["extensions"][EXTENSION]["micromaps"]

    def view(self, number):
        view = self.doc["bufferViews"][number]
        start = view.get("byteOffset", 0)
        return self.bin[start:start + view["byteLength"]]

    def element(self, accessor, number, width):
        a = self.doc["accessors"][accessor]
        code = CODES[a["componentType"]]
        stride = self.doc["bufferViews"][a["bufferView"]].get("byteStride", struct.calcsize("<" + code * width))
        return struct.unpack_from("<" + code * width, self.view(a["bufferView"]), a.get("byteOffset", 0) + stride * number)

    def primitive(self, mesh, primitive):
        return self.doc["meshes"][mesh]["primitives"][primitive]

    def uvs(self, mesh, primitive, triangle):
        p = self.primitive(mesh, primitive)
        corners = [self.element(p["indices"], 3 * triangle + k, 1)[0] for k in range(3)]
        return [self.element(p["attributes"]["TEXCOORD_0"], corner, 2) for corner in corners]

    def state(self, mesh, primitive, triangle, barycentrics):
        """(record or special index, level, micro-triangle index, name of the state) at the weights (u, v)."""
        extension = self.primitive(mesh, primitive)["extensions"][EXTENSION]
        accessor = extension["micromapIndices"]
        record = self.element(accessor, triangle, 1)[0]
        size = 2 ** (8 * struct.calcsize(CODES[self.doc["accessors"][accessor]["componentType"]]))
        if record >= size - 4:
            return record - size, 0, 0, STATES[size - 1 - record]
        micromaps = self.sets[extension["micromap"]]
        offset, level, layout = struct.unpack_from("<IHH", self.view(micromaps["triangles"]), 8 * record)
        index = barycentrics_to_index(*barycentrics, level)
        bit = index * layout
        byte = self.view(micromaps["data"])[offset + bit // 8]
        return record, level, index, STATES[(byte >> (bit % 8)) & (2**layout - 1)]


def weights(uvs, u, v):
    """Barycentrics of corners 1 and 2 at texture coordinates (u, v)."""
    (au, av), (bu, bv), (cu, cv) = uvs
    det = (bu - au) * (cv - av) - (bv - av) * (cu - au)
    return (((u - au) * (cv - av) - (v - av) * (cu - au)) / det, ((bu - au) * (v - av) - (bv - av) * (u - au)) / det)
