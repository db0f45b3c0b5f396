# cmake -DFOLDER=dir -DFILES=a|b/c -DHEADER=folder/name.h -DNAMESPACE=name -DOUTPUT=file.cpp -P embed.cmake
#
# Writes the files' bytes as the C++ arrays that the header declares in its namespace (shaders/embedded.h). Arrays of numbers, not string literals: they have no
# limit of length and no character that needs care.
set(arrays "")
set(table "")
set(count 0)
string(REPLACE "|" ";" names "${FILES}")
foreach(name IN LISTS names)
  file(READ "${FOLDER}/${name}" hex HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" hex "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
  file(SIZE "${FOLDER}/${name}" size)
  string(APPEND arrays "const char text_${count}[] = {\n${bytes}0};\n")
  string(APPEND table "    {\"${name}\", text_${count}, ${size}},\n")
  math(EXPR count "${count} + 1")
endforeach()
file(WRITE "${OUTPUT}" "// Written by cmake/embed.cmake.
#include \"${HEADER}\"

namespace ${NAMESPACE} {
namespace {
${arrays}}  // namespace

const File kFiles[] = {
${table}    {},
};
const std::size_t kFileCount = ${count};

}  // namespace ${NAMESPACE}
")
