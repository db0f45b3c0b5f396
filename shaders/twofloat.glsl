// Numbers kept in two floats (hi + lo, |lo| <= ulp(hi)/2): about 48 bits, once a ray where 24 are not enough.
// T. J. Dekker, A floating-point technique for extending the available precision, Numer. Math. 18 (1971),
// DOI 10.1007/BF01397083; two_sum after Knuth. `precise` keeps compilers from undoing it.

#define TWO_FLOAT_FUNCTIONS(T, Two)                                                                   \
  struct Two {                                                                                        \
    T hi, lo;                                                                                         \
  };                                                                                                  \
  Two two_sum(T a, T b) {                                                                             \
    precise T s = a + b;                                                                              \
    precise T v = s - a;                                                                              \
    precise T e = (a - (s - v)) + (b - v);                                                            \
    return Two(s, e);                                                                                 \
  }                                                                                                   \
  Two two_product(T a, T b) {                                                                         \
    precise T p = a * b;                                                                              \
    precise T ca = 4097.0 * a;                                                                        \
    precise T ah = ca - (ca - a);                                                                     \
    precise T al = a - ah;                                                                            \
    precise T cb = 4097.0 * b;                                                                        \
    precise T bh = cb - (cb - b);                                                                     \
    precise T bl = b - bh;                                                                            \
    precise T e = ((ah * bh - p) + ah * bl + al * bh) + al * bl;                                      \
    return Two(p, e);                                                                                 \
  }                                                                                                   \
  Two add(Two a, Two b) {                                                                             \
    Two s = two_sum(a.hi, b.hi);                                                                      \
    precise T e = s.lo + (a.lo + b.lo);                                                               \
    return two_sum(s.hi, e);                                                                          \
  }                                                                                                   \
  Two multiply(Two a, Two b) {                                                                        \
    Two p = two_product(a.hi, b.hi);                                                                  \
    precise T e = p.lo + (a.hi * b.lo + a.lo * b.hi);                                                 \
    return two_sum(p.hi, e);                                                                          \
  }                                                                                                   \
  Two divide(Two a, Two b) {                                                                          \
    precise T q = a.hi / b.hi;                                                                        \
    Two p = two_product(q, b.hi);                                                                     \
    precise T r = ((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo);                                         \
    precise T e = r / b.hi;                                                                           \
    return two_sum(q, e);                                                                             \
  }

TWO_FLOAT_FUNCTIONS(float, TwoFloat)
TWO_FLOAT_FUNCTIONS(vec3, TwoVec3)

TwoVec3 two_vec3(TwoFloat a) { return TwoVec3(vec3(a.hi), vec3(a.lo)); }

// sqrt(a), a > 0: one Newton step from the float's root.
TwoFloat square_root(TwoFloat a) {
  precise float s = sqrt(a.hi);
  TwoFloat p = two_product(s, s);
  precise float r = ((a.hi - p.hi) - p.lo) + a.lo;
  precise float e = r / (2.0 * s);
  return two_sum(s, e);
}

TwoFloat dot_product(TwoVec3 a, TwoVec3 b) {
  TwoVec3 p = multiply(a, b);
  TwoFloat s = add(TwoFloat(p.hi.x, p.lo.x), TwoFloat(p.hi.y, p.lo.y));
  return add(s, TwoFloat(p.hi.z, p.lo.z));
}
