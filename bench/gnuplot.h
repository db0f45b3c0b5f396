// Drawings by gnuplot, which need not be there.
#pragma once

#include <string>
#include <vector>

namespace quincunx {

/// `text` as a string of gnuplot's, in single quotes: nothing but the quote itself has a meaning there.
std::string gnuplot_string(const std::string& text);

/// The number of `name` in `names`, to whose end it is added where it is not there: series in the order in which they are seen.
std::size_t place_of(std::vector<std::string>& names, const std::string& name);

/// Marks of a logarithmic axis, as `set xtics (..)` has them: 1, 2, 5, 10, .. and more of them where it spans little.
std::string gnuplot_marks(double low, double high);

enum class Drawn { yes, no_gnuplot, failed };

/// Runs gnuplot with `script` on its standard input, and makes what it writes to standard output the file `path`, whole or not at all.
/// Nothing else comes through; no shell is involved. Throws InputError where `path` cannot be written.
Drawn draw_with_gnuplot(const std::string& script, const std::string& path);

/// The same; where it cannot be drawn, says so on standard error, and takes an earlier drawing away, which would be taken for this one.
void draw_or_note(const std::string& script, const std::string& path);

}  // namespace quincunx
