// The viewer page, embedded in the binary at build time from client/web.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace farlight {

/// Content by path below client/web, as "viewer.js". The only files the server has.
const std::map<std::string, std::string, std::less<>>& viewer_files();

}  // namespace farlight
