// The quartic seven-direction box spline on the BCC lattice (twin of spline/bcc7.cpp).
#define COEFFICIENT(number) coefficient(number)
#define PIECE_FLOAT precise real
#include "bcc7_tables.glsl"
#define SPLINE_DEGREE 4
#define SPLINE_RESTRICT(b, a, d) PIECE_RESTRICT(b[0], b[1], b[2], b[3], b[4], a.x, a.y, a.z, d.x, d.y, d.z)
#include "kuhn.glsl"
