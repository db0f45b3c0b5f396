// Derives bcc7's net in exact rationals and writes the files that are made of it.
//   derive_bcc7 SOURCE_DIR    writes SOURCE_DIR/spline/bcc7_net.h and SOURCE_DIR/shaders/bcc7_tables.glsl
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "spline/bcc7_derivation.h"

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
  const auto net = quincunx::derive_bcc7_net();
  write(directory + "/spline/bcc7_net.h", quincunx::bcc7_net_header(net));
  write(directory + "/shaders/bcc7_tables.glsl", quincunx::bcc7_tables_glsl(net));
} catch (const std::exception& error) {
  std::fprintf(stderr, "derive_bcc7: %s\n", error.what());
  return 1;
}
