// Of splines whose cells are one piece each.
#define SPLINE_CUTS 0

struct AxisOrder {
  uint code;
};
AxisOrder axis_order(rvec3 u) { return AxisOrder(0u); }
uint order_code(AxisOrder r) { return 0u; }
AxisOrder coded_order(uint code) { return AxisOrder(0u); }
