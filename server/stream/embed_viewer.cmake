# Writes OUTPUT, a C++ file that holds the files of FOLDER as viewer_files(). Run with cmake -P.
set(types html "text/html; charset=utf-8" js "text/javascript; charset=utf-8" mjs "text/javascript; charset=utf-8"
          css "text/css; charset=utf-8" svg "image/svg+xml" png "image/png" ico "image/x-icon"
          txt "text/plain; charset=utf-8")

file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
list(SORT files)
set(arrays "")
set(rows "")
set(index 0)
foreach(file IN LISTS files)
  string(REGEX REPLACE ".*\\." "" extension ${file})
  list(FIND types ${extension} at)
  if(at EQUAL -1)
    continue()  # package.json's tests and the like are not for browsers
  endif()
  math(EXPR at "${at} + 1")
  list(GET types ${at} type)
  set(path "/${file}")
  if(file STREQUAL "index.html")
    set(path "/")
  endif()
  file(READ ${FOLDER}/${file} hex HEX)
  string(LENGTH "${hex}" length)
  math(EXPR length "${length} / 2")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
  string(APPEND arrays "constexpr char kFile${index}[] = {${bytes}'\\0'};\n")
  string(APPEND rows "    {\"${path}\", \"${type}\", {kFile${index}, ${length}}},\n")
  math(EXPR index "${index} + 1")
endforeach()

file(WRITE ${OUTPUT} "// Generated from the viewer page's files.
#include \"server/stream/viewer_files.h\"

#include <array>

namespace farlight {
namespace {
${arrays}
constexpr std::array<ViewerFile, ${index}> kFiles{{
${rows}}};
}  // namespace

std::span<const ViewerFile> viewer_files()
{
    return kFiles;
}

}  // namespace farlight
")
