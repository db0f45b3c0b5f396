// Derives the nets of the BCC lattice's box splines in exact rationals and writes the files that are made of them.
//   derive_box_splines SOURCE_DIR    writes SOURCE_DIR/spline/<name>_net.h and SOURCE_DIR/shaders/<name>_tables.glsl
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "spline/box_net_derivation.h"

namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("expected one argument, the source directory");
  const std::string directory = argv[1];
  for (const quincunx::DerivedSpline& spline : quincunx::derived_splines()) {
    const quincunx::ExactNet net = quincunx::derive_net(spline);
    write(directory + "/spline/" + spline.name + "_net.h", quincunx::net_header(spline, net));
    write(directory + "/shaders/" + spline.name + "_tables.glsl", quincunx::piece_tables_glsl(spline, net));
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "derive_box_splines: %s\n", error.what());
  return 1;
}
