// libFuzzer's entry. FARLIGHT_FUZZ_FORMAT says which kind of scene file the input is.
//
//   fuzz_glb CORPUS_FOLDER -max_total_time=600 -rss_limit_mb=4096
//
// Half of the mutations are ours, on values of the document; the others libFuzzer's, on the bytes
// of one of its parts.
#include "tests/scene/fuzz/mutation.h"

#include <cstdlib>
#include <cstring>
#include <iostream>

using farlight::SceneFormat;

namespace {

constexpr SceneFormat kFormat = SceneFormat::FARLIGHT_FUZZ_FORMAT;

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(
    std::uint8_t* data, std::size_t size, std::size_t most, unsigned int seed)
{
    std::mt19937 random(seed);
    auto parts = farlight::split_scene(kFormat, {reinterpret_cast<const char*>(data), size});
    if (seed % 2 == 0) {
        farlight::mutate_scene(parts, random);
    } else {
        std::string& part = !parts.binary.empty() && seed % 4 == 1 ? parts.binary : parts.json;
        const std::size_t before = part.size();
        part.resize(before + 64);  // room to grow
        part.resize(
            LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(part.data()), before, part.size()));
    }
    const std::string joined = farlight::join_scene(kFormat, parts);
    if (joined.size() > most)
        return LLVMFuzzerMutate(data, size, most);
    std::memcpy(data, joined.data(), joined.size());
    return joined.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string outcome =
        farlight::load_input(kFormat, {reinterpret_cast<const char*>(data), size});
    if (outcome != "loaded" && outcome != "refused") {
        std::cerr << "a scene loaded that breaks what is promised: " << outcome << std::endl;
        std::abort();
    }
    return 0;
}
