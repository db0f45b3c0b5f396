// The floats that kernels compute in.
#pragma once

namespace quincunx {

/// By which rays, roots and gradients are found. What is stored of a picture are 32-bit floats in any case.
enum class Precision { float32, float64 };

/// As --precision names it.
constexpr const char* precision_name(Precision precision) { return precision == Precision::float32 ? "float" : "double"; }
}  // namespace quincunx
