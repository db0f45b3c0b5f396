// Images in files, through OpenImageIO.
#pragma once

#include <string>
#include <vector>

namespace quincunx {

/// An image of named float32 channels, interleaved, row 0 at the top: pixels[(y*width + x)*channels.size() + c].
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< "R", "G", "B", "A", "Z", "N.X", ...
  std::vector<float> pixels;
};

/// Writes OpenEXR (32-bit float, every channel) or PNG (8-bit sRGB of R G B A, un-premultiplied not needed: over the
/// background already) by the path's extension, whole or not at all: beside, then renamed.
/// Throws InputError for another extension or a place that cannot be written.
void write_image(const Image& image, const std::string& path);

/// Reads any image OpenImageIO knows as float32. Throws InputError.
Image read_image(const std::string& path);

/// Throws InputError unless write_image could write `path` now (extension known, folder there and writable):
/// so that a long job does not fail at its end.
void check_image_path(const std::string& path);

}  // namespace quincunx
