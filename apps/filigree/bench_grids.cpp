#include "filigree/jobs/bench_grids.h"

#include "command.h"
#include "picture_options.h"
#include "text_table.h"

namespace filigree::app {

void addBenchGrids(CLI::App& bench, Commands& commands) {
    Command command(
        bench, "grids",
        "Measure compressed grids against Embree: bytes, build times, rays on one thread, and leaks",
        "filigree bench grids terrain torus --sizes 1025 --json grids.json");
    const auto options = std::make_shared<jobs::BenchGridsOptions>();
    const auto full = std::make_shared<bool>(false);
    auto& verb = command.options();
    verb.add_option("scenes", options->scenes,
                    "terrain and torus, made in code, or files as for the verb grids; default both shapes")
        ->type_name("SCENE");
    verb.add_option("--sizes", options->sizes,
                    "Vertices a side of the shapes, with commas between them; default 1025,2049")
        ->delimiter(',')
        ->type_name("N");
    verb.add_flag("--full", *full, "The size 4097, too, and ten times as many rays that look for leaks");
    verb.add_option("--methods", options->methods,
                    "Of triangles, triangles-compact, triangles-qbvh8, grids, grids-compact, paper and "
                    "lattice (default all these), and triangles-robust, with commas between them")
        ->delimiter(',')
        ->type_name("NAMES");
    verb.add_flag("--lossless", options->lossless,
                  "lattice keeps heightfields exactly; without, it errs as much as paper");
    verb.add_option("--rounds", options->rounds, "Runs of each row, of which the median counts; default 5")
        ->type_name("N");
    addSizeOption(verb, options->width, options->height, "800x800");
    verb.add_option("--leak-rays", options->leakRays,
                    "Rays aimed at the vertices and edges of a closed torus and a box; default 10000000")
        ->type_name("N");
    verb.add_option("--leak-size", options->leakSize,
                    "Vertices a side of that torus, and quads a side of the box; default 513")
        ->type_name("N");
    verb.add_option("--html", options->page, "A page with charts and tables")->type_name("FILE");
    command.onRun([command, options, full] {
        if (*full) {
            options->sizes.push_back(4097);
            options->leakRays *= 10;
        }
        auto progress = command.progress();
        return command.finish(jobs::benchGrids(*options, *command.executor(), progress),
                              [](const auto& summary) {
                                  printTable(jobs::benchGridsTable(summary));
                                  if (!summary.leaks.empty()) printTable(jobs::benchLeaksTable(summary));
                              });
    });
    commands.push_back(command);
}

}  // namespace filigree::app
