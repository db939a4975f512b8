// farlight-fuzz-seeds FOLDER: writes the seeds into FOLDER/json, FOLDER/gltf and FOLDER/glb.
#include "tests/scene/fuzz/seeds.h"

#include <filesystem>
#include <fstream>
#include <iostream>

int main(int count, char** arguments)
{
    if (count != 2) {
        std::cerr << "usage: farlight-fuzz-seeds FOLDER\n";
        return 2;
    }
    constexpr const char* kFolders[] = {"json", "gltf", "glb"};  // by SceneFormat
    for (const farlight::Seed& seed : farlight::fuzz_seeds()) {
        const std::filesystem::path folder =
            std::filesystem::path(arguments[1]) / kFolders[static_cast<std::size_t>(seed.format)];
        std::filesystem::create_directories(folder);
        std::ofstream(folder / seed.name, std::ios::binary) << seed.bytes;
    }
}
