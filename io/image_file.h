// Images in files, through OpenImageIO.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quincunx {

/// An image of named float32 channels, interleaved, row 0 at the top: pixels[(y*width + x)*channels.size() + c].
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< "R", "G", "B", "A", "Z", "N.X", ...
  std::vector<float> pixels;

  /// The number of the channel of that name, -1 where there is none.
  int channel(std::string_view name) const;
};

/// Writes an image by the path's extension, whole or not at all: beside, then renamed. The same image always makes
/// the same bytes.
///   .exr  OpenEXR, 32-bit float, zip; every channel under its name, every value as it is (infinite ones too)
///   .png  8-bit sRGB of the linear channels R G B, clamped to 0..1, not a number as 0; other channels are left out.
///         Where there is a channel A, the colours are taken as multiplied by it and PNG's straight alpha is made:
///         what is shown then depends on what the viewer puts behind. Leave A out for an opaque picture over its
///         own background.
/// Throws InputError for another extension, a place that cannot be written, or channels that do not fit.
void write_image(const Image& image, const std::string& path);

/// What write_image puts into a .png, as bytes. Throws InputError for channels that do not fit.
std::string png_bytes(const Image& image);

/// Reads any image OpenImageIO knows as float32; integers come as 0..1 without any change of their transfer or alpha.
/// The channels' order is OpenImageIO's (R G B A first), not that in which they were written: find them by name.
/// Throws InputError.
Image read_image(const std::string& path);

/// Throws InputError unless write_image could write `path` now (extension known, folder there and writable):
/// so that a long job does not fail at its end.
void check_image_path(const std::string& path);

}  // namespace quincunx
