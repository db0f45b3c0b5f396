// quincunx: isosurfaces of volumes on the BCC lattice.
#include "app/program.h"
#include "bench/compare.h"
#include "bench/stability.h"
#include "bench/sweep.h"

int main(int argc, char** argv) {
  using namespace quincunx;
  return run_program(
      {"quincunx", "Isosurfaces of volumes on the body-centred cubic (BCC) lattice, exact and certified.",
       QUINCUNX_VERSION},
      {info_command, convert_command, sample_command, eval_command, render_command, compare_command, sweep_command, stability_command, devices_command}, argc, argv);
}
