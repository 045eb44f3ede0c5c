// Writes the seeds of the fuzz target fil_read: make_fil_seeds FOLDER
#include "sample_fil.h"
#include "sample_fil_grids.h"

#include <cstdio>

int main(int argc, char** argv) {
    using namespace filigree;
    if (argc != 2) {
        std::fprintf(stderr, "make_fil_seeds FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder(argv[1]);
    const tests::SampleFil many;
    const tests::SampleFil none(0, false);
    tests::SampleFil textures(2, false);
    textures.contents.set.encoding = encoding::Encoding::bitmask;
    textures.contents.indices = {};
    for (const Result<uint64_t>& written :
         {io::writeFil(folder / "plain.fil", many.contents, false),
          io::writeFil(folder / "zstd.fil", many.contents, true),
          io::writeFil(folder / "no_maps.fil", none.contents, false),
          io::writeFil(folder / "textures.fil", textures.contents, false),
          io::writeFilGrids(folder / "grids_paper.fil", tests::sampleFilGrids(grid::Codec::paper), false),
          io::writeFilGrids(folder / "grids_lattice.fil", tests::sampleFilGrids(grid::Codec::lattice), false),
          io::writeFilGrids(folder / "grids_zstd.fil", tests::sampleFilGrids(grid::Codec::lattice), true)}) {
        if (written) continue;
        std::fprintf(stderr, "%s\n", written.error().message.c_str());
        return 1;
    }
    return 0;
}
