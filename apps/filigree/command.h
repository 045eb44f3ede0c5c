// What every verb shares: the common options, and how a result or an error leaves the program.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/file.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"

#include "terminal_progress.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace filigree::app {

enum ExitCode : int { done = 0, failed = 1, wrongUsage = 2 };

// `text` with control characters as '?': names from a file may not steer the terminal or break the line.
std::string oneLine(std::string text);

struct CommonOptions {
    std::filesystem::path json;
    unsigned threads = 0;  // 0: one for each processor
    bool quiet = false;
};

// One verb: its options live in its own closure, `run` does the work and gives the exit code.
class Command {
  public:
    // `example` is one command line, shown at the end of the verb's help.
    Command(CLI::App& parent, const std::string& name, const std::string& description,
            const std::string& example);

    [[nodiscard]] CLI::App& options() const { return *app_; }
    [[nodiscard]] const CommonOptions& common() const { return *common_; }
    void onRun(std::function<int()> run) { run_ = std::move(run); }
    [[nodiscard]] bool chosen() const { return app_->parsed(); }
    [[nodiscard]] int run() const { return run_(); }

    [[nodiscard]] std::unique_ptr<Executor> executor() const {
        return makeThreadedExecutor(common_->threads);
    }
    [[nodiscard]] TerminalProgress progress() const { return TerminalProgress(!common_->quiet); }

    // Prints notes to stderr and the result by `print` to stdout, unless --quiet; writes --json.
    template <class Summary, class Print>
    [[nodiscard]] int finish(const Result<Summary>& result, Print print) const {
        if (!result) return report(result.error());
        if (!common_->quiet) {
            if constexpr (requires { result->notes; }) printNotes(result->notes);
            print(*result);
        }
        return writeJson(toJson(*result));
    }

    // Prints `error` as one line on stderr and gives the exit code that it stands for.
    static int report(const Error& error);

  private:
    static void printNotes(const std::vector<std::string>& notes);
    [[nodiscard]] int writeJson(const std::string& json) const;

    CLI::App* app_;
    std::shared_ptr<CommonOptions> common_ = std::make_shared<CommonOptions>();
    std::function<int()> run_;
};

using Commands = std::vector<Command>;

// Each adds one verb.
void addBake(CLI::App& app, Commands& commands);
void addCompare(CLI::App& app, Commands& commands);
void addCompress(CLI::App& app, Commands& commands);
void addExpand(CLI::App& app, Commands& commands);
void addValidate(CLI::App& app, Commands& commands);
void addGrids(CLI::App& app, Commands& commands);
void addInspect(CLI::App& app, Commands& commands);
void addBench(CLI::App& app, Commands& commands);
void addBenchEncode(CLI::App& bench, Commands& commands);
void addBenchGrids(CLI::App& bench, Commands& commands);
void addBenchLookup(CLI::App& bench, Commands& commands);
void addBenchTrace(CLI::App& bench, Commands& commands);
void addBenchVulkan(CLI::App& bench, Commands& commands);
void addRender(CLI::App& app, Commands& commands);
void addDemo(CLI::App& app, Commands& commands);
void addVq(CLI::App& app, Commands& commands);

}  // namespace filigree::app
