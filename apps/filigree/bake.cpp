#include "filigree/jobs/bake.h"

#include "bake_options.h"
#include "command.h"

namespace filigree::app {

void addBake(CLI::App& app, Commands& commands) {
    Command command(app, "bake", "Bake the alpha of a glTF scene to opacity micromaps",
                    "filigree bake forest.glb -o forest-omm.glb");
    const auto options = std::make_shared<jobs::BakeOptions>();
    auto& verb = command.options();
    verb.add_option("input", options->input, "The scene: .glb or .gltf")->required()->type_name("IN");
    auto* output = verb.add_option("-o,--output", options->output, "Where the scene with micromaps goes")
                       ->type_name("OUT");
    auto* raw = verb.add_option("--raw", options->rawFolder,
                                "A folder for blobs that Vulkan and DXR take as they are")
                    ->type_name("DIR");
    verb.callback([output, raw] {
        if (output->empty() && raw->empty()) throw CLI::RequiredError("-o or --raw");
    });
    addBakeOptions(verb, options->parameters);
    command.onRun([command, options] {
        auto progress = command.progress();
        return command.finish(jobs::bake(*options, *command.executor(), progress), printSummary);
    });
    commands.push_back(command);
}

}  // namespace filigree::app
