#include <iostream>

#include <filigree/bake.h>

int main() {
    using namespace filigree;
    std::vector<uint8_t> rgba(64 * 64 * 4, 0);  // a picture of yours; here opaque right of its diagonal
    for (size_t k = 0; k < 64 * 64; ++k) rgba[4 * k + 3] = k % 64 > k / 64 ? 255 : 0;
    const std::vector<mesh::UvTriangle> triangles{{{{{0, 0}, {1, 0}, {0, 1}}}}, {{{{1, 0}, {1, 1}, {0, 1}}}}};
    const auto alpha = image::alphaImageFrom({.bytes = rgba, .width = 64, .height = 64});
    const auto baked = alpha ? bake::bake(triangles, {*alpha}, {.cutoff = 0.5}) : alpha.error();
    const auto maps = baked ? micromap::flatten(baked->set) : baked.error();
    if (!maps) return std::cerr << maps.error().message << '\n', 1;
    std::cout << maps->records.size() << " micromaps, " << maps->data.size() << " bytes\n";
}
