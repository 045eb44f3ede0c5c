#include "command.h"

#include <fmt/format.h>

namespace filigree::app {

Command::Command(CLI::App& parent, const std::string& name, const std::string& description,
                 const std::string& example)
    : app_(parent.add_subcommand(name, description)) {
    app_->footer("Example: " + example);
    app_->add_option("--json", common_->json, "Write the result as JSON to this file")
        ->type_name("FILE")
        ->group("Common options");
    app_->add_option("--threads", common_->threads, "Threads; 0, the default, is one for each processor")
        ->type_name("N")
        ->group("Common options")
        ->check(CLI::Range(0, 1024).description(""));
    app_->add_flag("--quiet", common_->quiet, "Print nothing but errors")->group("Common options");
}

std::string oneLine(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < ' ' || c == 0x7F) c = '?';
    }
    return text;
}

int Command::report(const Error& error) {
    fmt::print(stderr, "filigree: {}\n", oneLine(error.message));
    return error.kind == ErrorKind::usage ? wrongUsage : failed;
}

void Command::printNotes(const std::vector<std::string>& notes) {
    for (const auto& note : notes) fmt::print(stderr, "note: {}\n", oneLine(note));
}

int Command::writeJson(const std::string& json) const {
    if (common_->json.empty()) return done;
    const Status written = writeFile(common_->json, json + "\n");
    return written ? done : report(written.error());
}

}  // namespace filigree::app
