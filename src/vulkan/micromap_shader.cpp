#include "vulkan/micromap_shader.h"

#include <cassert>
#include <cstring>
#include <string_view>

namespace filigree::vulkan {
namespace {

// Instructions and numbers of the SPIR-V specification.
constexpr uint32_t opExtension = 10;
constexpr uint32_t opExtInstImport = 11;
constexpr uint32_t opMemoryModel = 14;
constexpr uint32_t opEntryPoint = 15;
constexpr uint32_t opCapability = 17;
constexpr uint32_t opTypeBool = 20;
constexpr uint32_t opConstantTrue = 41;
constexpr uint32_t opFunction = 54;
constexpr uint32_t opExecutionModeId = 331;
constexpr uint32_t micromapCapability = 5381;
constexpr uint32_t micromapMode = 6031;
constexpr std::string_view micromapExtension = "SPV_EXT_opacity_micromap";
constexpr size_t headerWords = 5;
constexpr size_t boundAt = 3;

uint32_t opcode(uint32_t word) {
    return word & 0xffff;
}

// Places of a module's instructions; 0: there is none.
struct Landmarks {
    size_t imports = 0;     // the first word behind capabilities and extensions
    size_t entryPoint = 0;  // its first word
    size_t boolType = 0;
    size_t functions = 0;
};

Landmarks landmarksOf(std::span<const uint32_t> code) {
    Landmarks found;
    const auto note = [](size_t& at, size_t here) {
        if (at == 0) at = here;
    };
    for (size_t at = headerWords; at < code.size(); at += code[at] >> 16) {
        assert(code[at] >> 16 != 0);
        const uint32_t op = opcode(code[at]);
        if (op == opExtInstImport || op == opMemoryModel) note(found.imports, at);
        if (op == opEntryPoint) note(found.entryPoint, at);
        if (op == opTypeBool) note(found.boolType, at);
        if (op == opFunction) note(found.functions, at);
    }
    return found;
}

std::vector<uint32_t> extensionInstruction(std::string_view name) {
    std::vector<uint32_t> words(1 + name.size() / 4 + 1);
    words[0] = static_cast<uint32_t>(words.size()) << 16 | opExtension;
    std::memcpy(&words[1], name.data(), name.size());
    return words;
}

// Instructions for three places of a module; they are put in from the last to the first, so that places stay.
class ModuleEditor {
  public:
    explicit ModuleEditor(std::span<const uint32_t> code)
        : code_(code.begin(), code.end()), at_(landmarksOf(code)) {}

    void addCapability() {
        declarations_ = {2u << 16 | opCapability, micromapCapability};
        extensions_ = extensionInstruction(micromapExtension);
    }

    void addQueryMode() {
        const uint32_t type = at_.boolType != 0 ? code_[at_.boolType + 1] : newBool();
        const uint32_t value = code_[boundAt]++;
        constants_.insert(constants_.end(), {3u << 16 | opConstantTrue, type, value});
        modes_ = {4u << 16 | opExecutionModeId, code_[at_.entryPoint + 2], micromapMode, value};
    }

    std::vector<uint32_t> finish() {
        put(at_.functions, constants_);
        put(at_.entryPoint + (code_[at_.entryPoint] >> 16), modes_);
        put(at_.imports, extensions_);
        put(headerWords, declarations_);
        return std::move(code_);
    }

  private:
    uint32_t newBool() {
        const uint32_t type = code_[boundAt]++;
        constants_ = {2u << 16 | opTypeBool, type};
        return type;
    }
    void put(size_t at, const std::vector<uint32_t>& words) {
        code_.insert(code_.begin() + static_cast<std::ptrdiff_t>(at), words.begin(), words.end());
    }

    std::vector<uint32_t> code_;
    Landmarks at_;
    std::vector<uint32_t> declarations_;
    std::vector<uint32_t> extensions_;
    std::vector<uint32_t> modes_;
    std::vector<uint32_t> constants_;
};

}  // namespace

std::vector<uint32_t> withMicromaps(std::span<const uint32_t> code, const MicromapDeclarations& wanted) {
    ModuleEditor editor(code);
    if (wanted.twoStateFlag || wanted.queryMode) editor.addCapability();
    if (wanted.queryMode) editor.addQueryMode();
    return editor.finish();
}

}  // namespace filigree::vulkan
