#include "io/png.h"

#include <bit>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>
#include <spng.h>

namespace filigree::io {
namespace {

static_assert(std::endian::native == std::endian::little,
              "libspng gives 16-bit texels in the machine's order");

struct FreeContext {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, FreeContext>;

Error pngError(int code) {
    return {ErrorKind::format, fmt::format("PNG: {}", spng_strerror(code))};
}

// Deflate makes at most 1032 bytes of one, so a small file that claims a huge image is refused before
// anything is allocated for it.
Status checkSize(const spng_ihdr& header, size_t fileBytes) {
    constexpr uint64_t mostPerByte = 1032;
    const uint64_t texels = uint64_t{header.width} * header.height;
    if (texels > maxImageTexels) {
        return Error{ErrorKind::limit, fmt::format("PNG: {} x {} texels, at most {} are decoded",
                                                   header.width, header.height, maxImageTexels)};
    }
    constexpr std::array<unsigned, 7> channels{1, 0, 3, 1, 2, 0, 4};  // by PNG colour type
    const uint64_t bits = uint64_t{header.bit_depth} * channels[header.color_type];
    if (texels * bits / 8 > fileBytes * mostPerByte) {
        return Error{ErrorKind::format, fmt::format("PNG: {} bytes cannot hold {} x {} texels", fileBytes,
                                                    header.width, header.height)};
    }
    return {};
}

// A decoder that has read the header and found its claims plausible.
class Decoder {
  public:
    static Result<Decoder> open(std::span<const uint8_t> bytes) {
        Decoder decoder;
        decoder.context_.reset(spng_ctx_new(0));
        spng_ctx* context = decoder.context_.get();
        if (context == nullptr) return Error{ErrorKind::limit, "PNG: out of memory"};
        spng_set_image_limits(context, image::maxImageSide, image::maxImageSide);
        spng_set_chunk_limits(context, size_t{1} << 26, size_t{1} << 27);
        int code = spng_set_png_buffer(context, bytes.data(), bytes.size());
        if (code == 0) code = spng_get_ihdr(context, &decoder.header_);
        if (code != 0) return pngError(code);
        if (const Status size = checkSize(decoder.header_, bytes.size()); !size) return size.error();
        return decoder;
    }

    [[nodiscard]] const spng_ihdr& header() const { return header_; }
    [[nodiscard]] size_t texels() const { return size_t{header_.width} * header_.height; }

    // Reads all chunks before the image data to see whether there is a tRNS chunk.
    bool hasTransparency() {
        spng_trns ignored{};
        return spng_get_trns(context_.get(), &ignored) == 0;
    }

    // The whole image as T values in an spng format, `channels` a texel.
    template <class T>
    Result<std::vector<T>> decode(spng_format format, size_t channels) {
        std::vector<T> values(texels() * channels);
        const int code = spng_decode_image(context_.get(), values.data(), values.size() * sizeof(T), format,
                                           SPNG_DECODE_TRNS);
        if (code != 0) return pngError(code);
        return values;
    }

  private:
    Context context_;
    spng_ihdr header_{};
};

constexpr uint16_t widen(uint8_t value) {
    return static_cast<uint16_t>(value * 257);
}
constexpr uint16_t widen(uint16_t value) {
    return value;
}

// One channel of a decoded image.
template <class T>
Result<image::AlphaImage> channelOf(Decoder& decoder, spng_format format, size_t channels, size_t channel) {
    const Result<std::vector<T>> values = decoder.decode<T>(format, channels);
    if (!values) return values.error();
    image::AlphaImage alpha{
        decoder.header().width, decoder.header().height, {}, sizeof(T) == 1 ? 255U : 65535U};
    alpha.texels.resize(decoder.texels());
    for (size_t i = 0; i < alpha.texels.size(); ++i)
        alpha.texels[i] = widen((*values)[i * channels + channel]);
    return alpha;
}

Result<image::AlphaImage> rgbaChannel(Decoder& decoder, size_t channel) {
    return decoder.header().bit_depth == 16 ? channelOf<uint16_t>(decoder, SPNG_FMT_RGBA16, 4, channel)
                                            : channelOf<uint8_t>(decoder, SPNG_FMT_RGBA8, 4, channel);
}

bool isGrey(const spng_ihdr& header) {
    return header.color_type == SPNG_COLOR_TYPE_GRAYSCALE;
}

bool hasAlphaChannel(const spng_ihdr& header) {
    return header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
           header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
}

Result<std::vector<uint8_t>> encode(const spng_ihdr& header, std::span<const uint8_t> values) {
    const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
    if (context == nullptr) return Error{ErrorKind::limit, "PNG: out of memory"};
    spng_ihdr copy = header;
    spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
    int code = spng_set_ihdr(context.get(), &copy);
    if (code == 0) {
        code = spng_encode_image(context.get(), values.data(), values.size(), SPNG_FMT_PNG,
                                 SPNG_ENCODE_FINALIZE);
    }
    size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> png(
        code == 0 ? spng_get_png_buffer(context.get(), &size, &code) : nullptr, &std::free);
    if (png == nullptr) return pngError(code);
    const auto* bytes = static_cast<const uint8_t*>(png.get());
    return std::vector<uint8_t>(bytes, bytes + size);
}

spng_ihdr headerOf(uint32_t width, uint32_t height, uint8_t depth, spng_color_type type) {
    spng_ihdr header{};
    header.width = width;
    header.height = height;
    header.bit_depth = depth;
    header.color_type = static_cast<uint8_t>(type);
    return header;
}

}  // namespace

Result<ImageSize> pngSize(std::span<const uint8_t> bytes) {
    const Result<Decoder> decoder = Decoder::open(bytes);
    if (!decoder) return decoder.error();
    return ImageSize{decoder->header().width, decoder->header().height};
}

Result<scene::ColourImage> decodePng(std::span<const uint8_t> bytes) {
    Result<Decoder> decoder = Decoder::open(bytes);
    if (!decoder) return decoder.error();
    Result<std::vector<uint8_t>> values = decoder->decode<uint8_t>(SPNG_FMT_RGBA8, 4);
    if (!values) return values.error();
    return scene::ColourImage{decoder->header().width, decoder->header().height, std::move(*values)};
}

Result<image::AlphaImage> decodePngAlpha(std::span<const uint8_t> bytes, bool greyAsAlpha) {
    Result<Decoder> decoder = Decoder::open(bytes);
    if (!decoder) return decoder.error();
    const bool hasAlpha = hasAlphaChannel(decoder->header()) || decoder->hasTransparency();
    if (hasAlpha || !greyAsAlpha) return rgbaChannel(*decoder, 3);
    if (!isGrey(decoder->header())) {
        return Error{ErrorKind::format, "PNG: colour without alpha, expected grey or an alpha channel"};
    }
    return rgbaChannel(*decoder, 0);
}

Result<GreyImage> decodePngGrey(std::span<const uint8_t> bytes) {
    Result<Decoder> decoder = Decoder::open(bytes);
    if (!decoder) return decoder.error();
    const spng_ihdr& header = decoder->header();
    if (!isGrey(header) || header.bit_depth < 8) {
        return Error{ErrorKind::format,
                     fmt::format("PNG: colour type {} of {} bits, expected grey of 8 or 16",
                                 header.color_type, header.bit_depth)};
    }
    GreyImage grey{{header.width, header.height}, {}};
    if (header.bit_depth == 16) {
        Result<std::vector<uint16_t>> values = decoder->decode<uint16_t>(SPNG_FMT_PNG, 1);
        if (!values) return values.error();
        grey.values = std::move(*values);
    } else {
        const Result<std::vector<uint8_t>> values = decoder->decode<uint8_t>(SPNG_FMT_PNG, 1);
        if (!values) return values.error();
        grey.values.assign(values->begin(), values->end());
    }
    return grey;
}

Result<std::vector<uint8_t>> encodePng(const scene::ColourImage& image) {
    return encode(headerOf(image.width, image.height, 8, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA), image.rgba);
}

Result<std::vector<uint8_t>> encodeGreyPng(uint32_t width, uint32_t height, std::span<const uint8_t> texels) {
    return encode(headerOf(width, height, 8, SPNG_COLOR_TYPE_GRAYSCALE), texels);
}

Result<std::vector<uint8_t>> encodeGreyPng(uint32_t width, uint32_t height,
                                           std::span<const uint16_t> texels) {
    const std::span<const uint8_t> bytes(reinterpret_cast<const uint8_t*>(texels.data()),
                                         texels.size_bytes());
    return encode(headerOf(width, height, 16, SPNG_COLOR_TYPE_GRAYSCALE), bytes);
}

}  // namespace filigree::io
