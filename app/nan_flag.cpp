#include "app/nan_flag.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/flags.h"
#include "app/values.h"
#include "lattice/error.h"
#include "lattice/quote.h"

namespace quincunx {

NanPolicy parse_nan_policy(std::string_view text, std::string_view flag) {
  constexpr std::string_view kFill = "fill=";
  if (text == "refuse") return {};
  if (text == "empty") return {NanPolicy::Kind::empty, 0.0};
  if (!text.starts_with(kFill)) throw InputError(fmt::format("{}: found {}, expected refuse, empty or fill=V", flag, in_quotes(text)));
  const double value = parse_number(text.substr(kFill.size()), flag);
  if (std::abs(value) > double(std::numeric_limits<float>::max()))
    throw InputError(fmt::format("{}: found {}, expected a value that a 32-bit float holds", flag, in_quotes(text)));
  return {NanPolicy::Kind::fill, value};
}

CLI::Option* add_nan(CLI::App& app, NanPolicy& policy) {
  const auto parse = [&policy](const std::string& text) { policy = parse_nan_policy(text, "--nan"); };
  return add_parsed(app, "--nan", parse, "{refuse,empty,fill=V}", "refuse",
                    "Samples that are NaN or infinite: an error, nothing to be seen where they have a weight, or taken as V");
}

}  // namespace quincunx
