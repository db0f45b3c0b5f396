// The linear four-direction box spline on the BCC lattice (twin of spline/bcc4.cpp).
#define COEFFICIENT(number) coefficient(number)
#define PIECE_FLOAT precise real
#include "bcc4_tables.glsl"
#define SPLINE_DEGREE 1
#define SPLINE_RESTRICT(b, a, d) PIECE_RESTRICT(b[0], b[1], a.x, a.y, a.z, d.x, d.y, d.z)
#include "kuhn.glsl"
