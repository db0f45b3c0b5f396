// quincunx-bench: error against time, time against size, leaves against time, ways to ask for opacity, volumes against a closed form, orders of
// approximation, 32-bit against 64-bit floats, voxels against samples.
#include "app/program.h"
#include "bench/cluster.h"
#include "bench/convergence.h"
#include "bench/growth.h"
#include "bench/intersect.h"
#include "bench/precision.h"
#include "bench/ranges.h"
#include "bench/steps.h"
#include "bench/voxels.h"

int main(int argc, char** argv) {
  using namespace quincunx;
  return run_program({"quincunx-bench", "Error against time: what each way of rendering costs, and what it gets wrong.",
                      QUINCUNX_VERSION},
                     {intersect_command, growth_command, cluster_command, ranges_command, steps_command, convergence_command, precision_command, voxels_command}, argc, argv);
}
