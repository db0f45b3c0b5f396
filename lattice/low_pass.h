// A volume without the frequencies that a coarser grid cannot hold.
#pragma once

#include <glm/glm.hpp>

#include "lattice/progress.h"
#include "lattice/volume.h"

namespace quincunx {

/// The highest frequency along an axis that a lattice holds, cycles per lattice coordinate: 1/2 of the Cartesian one. What the BCC lattice holds is the
/// Voronoi cell of its dual, face-centred cubic lattice, a rhombic dodecahedron |f_x| + |f_y| <= 1/2 ... which no separable filter has;
/// it is approximated by the cube of the same volume, 2^-5/3 = 0.315: that of the Cartesian lattice of as many samples.
double band_limit(LatticeKind lattice);

/// The volume's samples, extended by clamping each index of each coset, convolved along each axis with a sinc of the cut-off, half of which is let
/// through, in a Kaiser window of beta = 6 and 6 of its zeros on either side: from 1.35 times the cut-off on less than 1/1000 is. `cutoff`:
/// cycles per lattice coordinate, above 0 each; axes whose cut-off is infinite are left as they are (Cartesian volumes only: on the BCC lattice a
/// sample is a sum over both cosets, and all three are finite). The weights sum to 1, and some are negative: beside sharp edges the result
/// rings, by a tenth of their height. The result is of float samples, with the same notes.
/// Throws InputError where samples are not finite.
Volume low_pass(const Volume& volume, const glm::dvec3& cutoff, const Progress& progress = {});

}  // namespace quincunx
