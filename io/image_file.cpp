#include "io/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "io/atomic_file.h"
#include "io/input_file.h"
#include "lattice/error.h"

namespace quincunx {
namespace {

/// "exr" or "png". Throws InputError for another extension.
std::string image_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  if (extension == ".exr" || extension == ".png") return extension.substr(1);
  throw InputError(fmt::format("{}: found extension '{}', expected .exr or .png", path, extension));
}

/// The first line of a library's message.
std::string first_line(const std::string& message) { return message.substr(0, message.find('\n')); }

void check_image(const Image& image, const std::string& path) {
  const std::size_t values =
      std::size_t(std::max(image.width, 0)) * std::size_t(std::max(image.height, 0)) * image.channels.size();
  if (values == 0 || image.pixels.size() != values) {
    throw InputError(
        fmt::format("{}: {} values for an image of {} x {} pixels and {} channels, expected {} and at least 1", path,
                    image.pixels.size(), image.width, image.height, image.channels.size(), values));
  }
}

/// IEC 61966-2-1: the sRGB code 0..255 of a linear value.
std::uint8_t srgb(double linear) {
  if (!(linear > 0.0)) return 0;
  if (linear >= 1.0) return 255;
  const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return std::uint8_t(std::lround(255.0 * encoded));
}

/// R G B and, where there is one, A of `image` as PNG wants them: sRGB, straight alpha, 8 bits.
std::vector<std::uint8_t> png_pixels(const Image& image, const std::string& path) {
  const int red = image.channel("R"), green = image.channel("G"), blue = image.channel("B"), alpha = image.channel("A");
  if (red < 0 || green < 0 || blue < 0) {
    throw InputError(fmt::format("{}: channels R, G and B are not all there, expected them for a PNG", path));
  }
  std::vector<std::uint8_t> pixels;
  const std::size_t count = image.pixels.size() / image.channels.size();
  pixels.reserve(count * 4);
  for (std::size_t p = 0; p < count; ++p) {
    const float* pixel = image.pixels.data() + p * image.channels.size();
    const double opacity = alpha < 0 || std::isnan(pixel[alpha]) ? 1.0 : std::clamp(double(pixel[alpha]), 0.0, 1.0);
    // Behind no opacity at all there is no colour to divide out.
    const double scale = opacity > 0.0 ? 1.0 / opacity : 1.0;
    for (const int c : {red, green, blue}) pixels.push_back(srgb(pixel[c] * scale));
    if (alpha >= 0) pixels.push_back(std::uint8_t(std::lround(255.0 * opacity)));
  }
  return pixels;
}

OIIO::ImageSpec png_spec(const Image& image) {
  OIIO::ImageSpec spec(image.width, image.height, image.channel("A") >= 0 ? 4 : 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  return spec;
}

/// Writes pixels of `type` described by `spec` to `path` through the plug-in `format`.
void write_pixels(const std::string& path, const std::string& format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                  const void* pixels) {
  AtomicFile file(path);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) throw InputError(fmt::format("{}: {}", path, first_line(OIIO::geterror())));
  const bool written = output->open(file.temporary(), spec) && output->write_image(type, pixels) && output->close();
  if (!written) throw InputError(fmt::format("{}: cannot be written: {}", path, first_line(output->geterror())));
  file.commit();
}

}  // namespace

int Image::channel(std::string_view name) const {
  const auto found = std::find(channels.begin(), channels.end(), name);
  return found == channels.end() ? -1 : int(found - channels.begin());
}

void write_image(const Image& image, const std::string& path) {
  const std::string format = image_format(path);
  check_image(image, path);
  if (format == "exr") {
    OIIO::ImageSpec spec(image.width, image.height, int(image.channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.alpha_channel = image.channel("A");
    spec.z_channel = image.channel("Z");
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // the library would write the time of day
    write_pixels(path, format, spec, OIIO::TypeDesc::FLOAT, image.pixels.data());
  } else {
    const std::vector<std::uint8_t> pixels = png_pixels(image, path);
    write_pixels(path, format, png_spec(image), OIIO::TypeDesc::UINT8, pixels.data());
  }
}

std::string png_bytes(const Image& image) {
  check_image(image, "png");
  const std::vector<std::uint8_t> pixels = png_pixels(image, "png");
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
  if (!output) throw std::runtime_error("png: " + first_line(OIIO::geterror()));
  output->set_ioproxy(&memory);
  const bool written = output->open("memory.png", png_spec(image)) && output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && output->close();
  if (!written) throw std::runtime_error("png: cannot be made: " + first_line(output->geterror()));
  return {bytes.begin(), bytes.end()};
}

Image read_image(const std::string& path) {
  const InputFile probe(path);  // says what is wrong with a path better than the library
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &config);
  if (!input) throw InputError(fmt::format("{}: cannot be read: {}", path, first_line(OIIO::geterror())));
  const OIIO::ImageSpec& spec = input->spec();
  Image image{spec.width, spec.height, spec.channelnames, {}};
  image.pixels.resize(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  const bool read = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data());
  if (!read) throw InputError(fmt::format("{}: cannot be read: {}", path, first_line(input->geterror())));
  return image;
}

void check_image_path(const std::string& path) {
  image_format(path);
  check_writable(path);
}

}  // namespace quincunx
