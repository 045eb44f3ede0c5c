#include "filigree/jobs/grids.h"

#include "filigree/core/file.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/io/fil_grids.h"
#include "filigree/report/number.h"
#include "filigree/trace/render.h"

#include "jobs/grid_error_map.h"
#include "jobs/grid_input.h"
#include "jobs/grid_lattice.h"
#include "jobs/grids_page.h"
#include "jobs/stopwatch.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

Error gridUsage(std::string message) {
    return {ErrorKind::usage, std::move(message)};
}

// The names among the options, looked up.
struct GridChoice {
    grid::Codec codec = grid::Codec::lattice;
    grid::DisplacementCode displacement = grid::DisplacementCode::unitVector;
};

Status checkPrecision(const GridPrecision& precision) {
    const int given =
        int{precision.maxError.has_value()} + int{precision.matchPaper} + int{precision.lossless};
    if (given > 1) return gridUsage("--max-error, --match-paper and --lossless exclude each other");
    const double error = precision.maxError.value_or(1);
    if (!(error > 0) || !std::isfinite(error))
        return gridUsage(fmt::format("--max-error {}: give a length above 0", error));
    return {};
}

// Options that the codec does not have.
Status checkForCodec(const GridsOptions& options, grid::Codec codec) {
    if (const Status status = checkGridInput(options.input); !status) return status;
    const GridPrecision& precision = options.precision;
    const bool isExact = precision.maxError || precision.lossless;
    if (codec == grid::Codec::paper && (isExact || precision.matchPaper))
        return gridUsage("--max-error, --match-paper and --lossless are for --codec lattice");
    if (codec == grid::Codec::lattice && options.snap)
        return gridUsage("--snap: is for --codec paper; lattice has no cracks");
    if (codec == grid::Codec::lattice && isExact && !options.displacement.empty())
        return gridUsage("--displacement: is for --codec paper and --match-paper");
    if ((options.cell || options.heightScale) && !isHeightfield(options.input))
        return gridUsage("--cell and --height-scale: are for heightfields (.png)");
    if (!options.errorMap.empty() && options.errorMap.extension() != ".png")
        return gridUsage(fmt::format("--error-map {}: is a PNG; give a name that ends in .png",
                                     options.errorMap.string()));
    return trace::checkSize(options.width, options.height);
}

Result<GridChoice> choiceOf(const GridsOptions& options) {
    GridChoice choice;
    const auto codec = grid::codecNamed(options.codec);
    if (!codec) return gridUsage(fmt::format("--codec {}: expected paper or lattice", options.codec));
    choice.codec = *codec;
    if (!options.displacement.empty()) {
        const auto code = grid::displacementCodeNamed(options.displacement);
        if (!code)
            return gridUsage(fmt::format("--displacement {}: expected unit-vector or shared-exponent",
                                         options.displacement));
        choice.displacement = *code;
    }
    if (const Status status = checkPrecision(options.precision); !status) return status.error();
    if (const Status status = checkForCodec(options, choice.codec); !status) return status.error();
    return choice;
}

class GridsRun {
  public:
    GridsRun(const GridsOptions& options, const GridChoice& choice, const Executor& executor,
             ProgressSink& progress)
        : options_(options), choice_(choice), executor_(executor), progress_(progress) {}

    Result<GridsSummary> run() {
        const Stopwatch total;
        for (const auto stage : {&GridsRun::read, &GridsRun::choosePrecision, &GridsRun::encode,
                                 &GridsRun::measure, &GridsRun::draw, &GridsRun::write}) {
            if (const Status status = (this->*stage)(); !status) return status.error();
        }
        summary_.totalSeconds = total.seconds();
        return std::move(summary_);
    }

  private:
    Status read() {
        grid::ConvertOptions converting;
        converting.uniformDiagonals = choice_.codec == grid::Codec::paper;
        converting.turnQuads = converting.uniformDiagonals;
        converting.attributes = options_.attributes;
        io::HeightfieldOptions heights;
        heights.cell = options_.cell.value_or(heights.cell);
        heights.heightScale = options_.heightScale.value_or(heights.heightScale);
        auto asset = io::identifyAsset(options_.input);
        if (!asset) return asset.error();
        file_.asset = std::move(*asset);
        auto input = readGridInput(options_.input, converting, heights, executor_);
        if (!input) return input.error();
        mesh_ = std::move(input->mesh);
        summary_.notes = std::move(input->notes);
        summary_.readSeconds = input->readSeconds;
        summary_.convertSeconds = input->convertSeconds;
        summary_.statistics = grid::statisticsOf(mesh_);
        summary_.grids = mesh_.grids.size();
        summary_.diagonal = grid::boundsOf(mesh_).diagonal();
        if (summary_.diagonal > 0) return {};
        return Error{ErrorKind::format,
                     fmt::format("{}: all vertices stand in one point", options_.input.string())};
    }

    Status choosePrecision() {
        encoding_.codec = summary_.codec = choice_.codec;
        encoding_.displacement = choice_.displacement;
        encoding_.snap = options_.snap;
        if (choice_.codec == grid::Codec::paper) return {};
        const Stopwatch choosing;
        const auto chosen = chooseLattice(mesh_, options_.precision, choice_.displacement, executor_);
        if (!chosen) return chosen.error();
        encoding_.lattice = summary_.lattice = chosen->lattice;
        summary_.paperRms = chosen->paperRms;
        summary_.convertSeconds += choosing.seconds();
        return {};
    }

    Status encode() {
        const Stopwatch encoding;
        auto records = grid::encodeRecords(mesh_, encoding_, executor_, progress_);
        if (!records) return records.error().within(options_.input.string());
        summary_.encodeSeconds = encoding.seconds();
        const Stopwatch building;
        file_.grids = grid::buildGrids(std::move(*records), executor_);
        summary_.buildSeconds = building.seconds();
        summary_.bytes = grid::bytesOf(file_.grids);
        summary_.clusters = grid::clusterCount(file_.grids);
        return {};
    }

    Status measure() {
        const auto loose = static_cast<uint32_t>(mesh_.looseTriangles.size());
        decoded_ = grid::decodeGrids(file_.grids, mesh_.grids, loose, executor_);
        summary_.errors = grid::errorsOf(mesh_, decoded_, executor_);
        if (choice_.codec == grid::Codec::paper) summary_.cracks = grid::cracksOf(mesh_, decoded_);
        noteErrors();
        file_.attributes = options_.attributes ? grid::attributesOf(mesh_) : grid::GridAttributes();
        summary_.attributeBytes = file_.attributes.bytes();
        return {};
    }

    Status draw() {
        if (!options_.errorMap.empty()) {
            auto png = gridErrorMap(mesh_, decoded_, choice_.codec).png();
            if (!png) return png.error();
            errorMap_ = std::move(*png);
        }
        if (options_.page.empty()) return {};
        const GridViewSource source{mesh_, file_.grids, decoded_, file_.attributes};
        const auto page = makeGridsPage(options_, summary_, source, executor_, progress_);
        if (!page) return page.error();
        page_ = report::toHtml(*page);
        return {};
    }

    void noteErrors() {
        constexpr double coarse = 0.25;
        if (summary_.errors.subGridMax > coarse) {
            summary_.notes.push_back(
                fmt::format("the largest error is {} of its sub-grid; --max-error gives a finer lattice",
                            report::formatShare(summary_.errors.subGridMax)));
        }
        if (summary_.cracks && summary_.cracks->cracked > 0) {
            summary_.notes.push_back(
                fmt::format("the surface cracks at {} vertices; --snap or --codec lattice closes it",
                            report::formatCount(summary_.cracks->cracked)));
        }
    }

    Status write() {
        file_.table = mesh_.grids;
        file_.looseTriangles = static_cast<uint32_t>(mesh_.looseTriangles.size());
        const auto bytes = io::writeFilGrids(options_.output, file_, options_.zstd);
        if (!bytes) return bytes.error();
        summary_.fileBytes = *bytes;
        Status written = writePictures();
        std::error_code ignored;
        if (written) return written;
        std::filesystem::remove(options_.output, ignored);
        std::filesystem::remove(options_.errorMap, ignored);
        return written;
    }

    Status writePictures() {
        if (!options_.errorMap.empty()) {
            if (Status written = writeFile(options_.errorMap, errorMap_); !written) return written;
        }
        return options_.page.empty() ? Status() : writeFile(options_.page, page_);
    }

    const GridsOptions& options_;
    GridChoice choice_;
    const Executor& executor_;
    ProgressSink& progress_;
    grid::GridMesh mesh_;
    grid::EncodeOptions encoding_;
    io::FilGrids file_;
    grid::DecodedGrids decoded_;
    std::vector<uint8_t> errorMap_;
    std::string page_;
    GridsSummary summary_;
};

}  // namespace

Result<GridsSummary> grids(const GridsOptions& options, const Executor& executor, ProgressSink& progress) {
    const auto choice = choiceOf(options);
    if (!choice) return choice.error();
    return GridsRun(options, *choice, executor, progress).run();
}

}  // namespace filigree::jobs
