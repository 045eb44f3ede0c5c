"""Small glTF assets, made in code, to bake and to break."""

import json
import struct
import zlib


def png(width, height, alpha):
    """An RGBA PNG, white, whose alpha at (x, y) is alpha(x, y), 0..255."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    rows = b"".join(
        b"\0" + b"".join(bytes((255, 255, 255, alpha(x, y))) for x in range(width)) for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) +
            chunk(b"IEND", b""))


def disc(size):
    """Alpha of a disc with a soft edge."""
    def alpha(x, y):
        distance = ((x + 0.5 - size / 2)**2 + (y + 0.5 - size / 2)**2)**0.5
        return max(0, min(255, int(128 + 64 * (size * 0.35 - distance))))
    return alpha


class Asset:
    """A glTF document with one binary buffer. `doc` is the JSON, free to be changed before glb()."""

    def __init__(self):
        self.bin = b""
        self.doc = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": []}

    def view(self, data):
        self.bin += b"\0" * (-len(self.bin) % 4)
        self.doc["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bin), "byteLength": len(data)})
        self.bin += data
        return len(self.doc["bufferViews"]) - 1

    def accessor(self, code, component_type, kind, rows, **more):
        data = b"".join(struct.pack("<" + code * len(row), *row) for row in rows)
        self.doc["accessors"].append({"bufferView": self.view(data), "componentType": component_type,
                                      "count": len(rows), "type": kind, **more})
        return len(self.doc["accessors"]) - 1

    def glb(self):
        self.doc["buffers"] = [{"byteLength": len(self.bin)}]
        text = json.dumps(self.doc).encode()
        text += b" " * (-len(text) % 4)
        binary = self.bin + b"\0" * (-len(self.bin) % 4)
        return (struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary)) +
                struct.pack("<II", len(text), 0x4E4F534A) + text +
                struct.pack("<II", len(binary), 0x004E4942) + binary)


def leaf(size=32, alpha=None, image=None, mode="MASK"):
    """A quad of two triangles under a texture with a disc of alpha."""
    asset = Asset()
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    position = asset.accessor("f", 5126, "VEC3", [(x, y, 0) for x, y in corners], min=[0, 0, 0], max=[1, 1, 0])
    uv = asset.accessor("f", 5126, "VEC2", corners)
    indices = asset.accessor("H", 5123, "SCALAR", [(i,) for i in (0, 1, 2, 0, 2, 3)])
    image = image if image is not None else png(size, size, alpha or disc(size))
    asset.doc.update({
        "images": [{"name": "leaf", "bufferView": asset.view(image), "mimeType": "image/png"}],
        "textures": [{"source": 0}],
        "materials": [{"name": "leaf", "alphaMode": mode,
                       "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": position, "TEXCOORD_0": uv}, "indices": indices,
                                    "material": 0}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    })
    return asset
