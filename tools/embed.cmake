# Writes a C++ function that gives text files as a map from path to content.
# cmake -DOUT=file.cpp -DSYMBOL=function_name -DROOT=folder -DFILES="a;b" -P embed.cmake
set(code "// Generated from ${SYMBOL}'s sources by tools/embed.cmake.\n#include <functional>\n#include <map>\n#include <string>\n\nnamespace farlight {\nconst std::map<std::string, std::string, std::less<>>& ${SYMBOL}()\n{\nstatic const std::map<std::string, std::string, std::less<>> files = {\n")
foreach(path IN LISTS FILES)
  file(READ "${ROOT}/${path}" hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${hex}")
  # Adjacent literals, so that no line and no literal grows without bound.
  string(REGEX REPLACE "(................................................................)" "\\1\"\n\"" bytes "${bytes}")
  string(LENGTH "${hex}" digits)
  math(EXPR size "${digits} / 2")
  string(APPEND code "{\"${path}\", std::string(\"${bytes}\", ${size})},\n")
endforeach()
string(APPEND code "};\nreturn files;\n}\n}  // namespace farlight\n")
file(WRITE "${OUT}" "${code}")
