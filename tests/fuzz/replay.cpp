// Runs a fuzz target over its corpus without libFuzzer: every file as it is, cut short, and with single bits
// flipped.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

using Bytes = std::vector<uint8_t>;

// Runs the target on a copy of exactly this size, so that a sanitizer sees the first byte read past its end.
void run(const uint8_t* data, size_t size) {
    const auto copy = std::make_unique<uint8_t[]>(size);
    std::copy_n(data, size, copy.get());
    LLVMFuzzerTestOneInput(copy.get(), size);
}

// At most `most` of the numbers below `count`, evenly spread.
template <class Body>
size_t forSome(size_t count, size_t most, Body body) {
    const size_t runs = std::min(count, most);
    for (size_t i = 0; i < runs; ++i) body(count <= most ? i : i * count / most);
    return runs;
}

size_t replay(Bytes input, size_t most) {
    run(input.data(), input.size());
    size_t runs = 1;
    runs += forSome(input.size(), most, [&](size_t length) { run(input.data(), length); });
    runs += forSome(input.size() * 8, most, [&](size_t bit) {
        const auto mask = static_cast<uint8_t>(1U << (bit % 8));
        input[bit / 8] ^= mask;
        run(input.data(), input.size());
        input[bit / 8] ^= mask;
    });
    return runs;
}

std::vector<std::filesystem::path> corpus(const char* folder) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) {
        std::fprintf(stderr, "usage: %s CORPUS_FOLDER [RUNS]\n", argv[0]);
        return 2;
    }
    const auto files = corpus(argv[1]);
    if (files.empty()) {
        std::fprintf(stderr, "%s: no files; a corpus needs at least one\n", argv[1]);
        return 1;
    }
    const size_t usual = argc == 3 ? std::strtoul(argv[2], nullptr, 10) : 800;
    const size_t most = std::getenv("FILIGREE_FULL") != nullptr ? 20'000 : usual;
    size_t runs = 0;
    for (const auto& path : files) {
        std::ifstream file(path, std::ios::binary);
        runs += replay(Bytes(std::istreambuf_iterator<char>(file), {}), most);
    }
    std::printf("%zu inputs from %zu files\n", runs, files.size());
    return 0;
}
