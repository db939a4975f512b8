// What a scene lacks is not compiled, not allocated, not dispatched: a frame of a scene with an
// effect leaves exactly the traces of that effect more than one of the scene without. Traces are
// taken from the programs that drew, as the driver reflects them, from the books of memory and from
// the passes that ran.
#include "server/render/live_scene.h"
#include "tests/support/effect_pairs.h"
#include "tests/support/gl_test.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <unistd.h>

namespace farlight {

void PrintTo(const Effect& effect, std::ostream* out)
{
    *out << effect.name;
}

namespace {

using Traces = std::set<std::string>;

/// What the compiler is given to read: the text without what is compiled out.
std::string preprocessed(const ShaderSource& source)
{
    const std::string file = testing::TempDir() + "effect_traces_" + std::to_string(getpid());
    std::istringstream lines(source.text);
    std::ofstream without_version(file);
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("#version") && !line.starts_with("#line"))
            without_version << line << "\n";
    without_version.close();
    const std::string command = FARLIGHT_PREPROCESSOR " -E -P -w -x c++ " + file;
    std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    char part[4096];
    while (std::size_t count = std::fread(part, 1, sizeof part, pipe.get()))
        text.append(part, count);
    std::remove(file.c_str());
    EXPECT_NE(text.find("main"), std::string::npos) << command;
    return text;
}

bool contains_word(const std::string& text, const std::string& word)
{
    const auto continues = [&](std::size_t at) {
        return at < text.size() && (std::isalnum(text[at]) != 0 || text[at] == '_');
    };
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if (!continues(at - 1) && !continues(at + word.size()))
            return true;
    return false;
}

/// What a pattern with groups `(a|b)` stands for, each alone: `x(a|b)` for `xa` and `xb`.
std::vector<std::string> alternatives(const std::string& pattern)
{
    const std::size_t open = pattern.find('(');
    if (open == std::string::npos)
        return {pattern};
    const std::size_t close = pattern.find(')', open);
    std::vector<std::string> all;
    std::istringstream group(pattern.substr(open + 1, close - open - 1));
    for (std::string one; std::getline(group, one, '|');)
        for (const std::string& rest : alternatives(pattern.substr(close + 1)))
            all.push_back(pattern.substr(0, open) + one + rest);
    return all;
}

/// The values of a setting that calls for an effect, without and with it.
std::pair<std::string, std::string> values_of(std::string_view setting)
{
    if (setting == "denoiser")
        return {"none", "svgf"};
    return {"0", "1"};
}

/// One frame of a scene, and all that is known of it.
struct Drawn {
    EffectMask mask;
    Traces traces;
    std::vector<ProgramKey> programs;
};

class EffectTracesTest : public GlTest, public testing::WithParamInterface<Effect> {
protected:
    Drawn draw(Scene scene, const Effect& effect, bool with)
    {
        RenderSettings settings;
        settings.effects = {EffectChoice::Kind::kList, {}};
        if (const auto [off, on] = values_of(effect.setting); !effect.setting.empty())
            set_setting(settings, std::string(effect.setting) + "=" + (with ? on : off));

        const LoadedScene loaded = load_onto_device(std::move(scene));
        ScenePrograms scene_programs(programs_, nullptr, nullptr, {});
        scene_programs.follow(loaded.gpu);
        SharedScene shared{programs_, scene_programs, loaded.look,
            static_cast<std::uint32_t>(loaded.gpu->light_count()), true};
        shared.gpu = loaded.gpu.get();
        shared.keep_all = true;  // or textures that are used again have the name of their last use
        View view(shared);
        RenderRequest request = linear_request(*loaded.scene, {6, 6}, settings);
        request.refine = !effect.setting.empty();  // averages, whatever the denoiser
        const RenderedFrame frame = view.render(request);

        Drawn drawn{frame.effects, {}, view.graph().programs()};
        for (const Allocation& buffer : loaded.gpu->allocations())
            drawn.traces.insert("buffer " + buffer.name);
        for (const auto& [name, bytes] : frame.memory)
            drawn.traces.insert("texture " + name);
        for (const PassTime& pass : frame.pass_times)
            drawn.traces.insert("pass " + pass.pass);
        for (const ProgramKey& key : drawn.programs)
            for (const auto& [name, variable] : programs_.get(key).uniforms())
                drawn.traces.insert("uniform " + name);
        return drawn;
    }

    bool has_word(const Drawn& drawn, const std::string& word)
    {
        return std::any_of(
            drawn.programs.begin(), drawn.programs.end(), [&](const ProgramKey& key) {
                auto& text = texts_[key];
                if (text.empty())
                    text = preprocessed(load_shader_source(key.shader, key.defines));
                return contains_word(text, word);
            });
    }

    void expect_traces(const EffectPair& pair, const Drawn& without, const Drawn& with)
    {
        Traces gone;
        std::set_difference(without.traces.begin(), without.traces.end(), with.traces.begin(),
            with.traces.end(), std::inserter(gone, gone.end()));
        EXPECT_THAT(gone, testing::IsEmpty());
        Traces unexplained;
        std::set_difference(with.traces.begin(), with.traces.end(), without.traces.begin(),
            without.traces.end(), std::inserter(unexplained, unexplained.end()));
        const Traces added = unexplained;
        for (const std::string trace : pair.traces) {
            if (trace.starts_with("code ")) {
                EXPECT_FALSE(has_word(without, trace.substr(5))) << trace;
                EXPECT_TRUE(has_word(with, trace.substr(5))) << trace;
                continue;
            }
            for (const std::string& one : alternatives(trace)) {
                const std::regex pattern(one);
                const auto speaks = [&](const std::string& t) {
                    return std::regex_match(t, pattern);
                };
                EXPECT_TRUE(std::any_of(added.begin(), added.end(), speaks)) << one;
                std::erase_if(unexplained, speaks);
            }
        }
        EXPECT_THAT(unexplained, testing::IsEmpty());
    }

    ProgramCache programs_;
    std::map<ProgramKey, std::string> texts_;
};

TEST_P(EffectTracesTest, AreThoseOfTheEffectAndNoOthers)
{
    const Effect& effect = GetParam();
    const std::vector<EffectPair> pairs = effect_pairs();
    const auto pair = std::find_if(pairs.begin(), pairs.end(),
        [&](const EffectPair& candidate) { return candidate.effect == effect.name; });
    ASSERT_NE(pair, pairs.end()) << "has no pair of scenes";
    EXPECT_FALSE(pair->traces.empty()) << "leaves no trace";
    Scene scene = lit_scene();
    pair->without(scene);
    const Drawn without = draw(scene, effect, false);
    pair->with(scene);
    const Drawn with = draw(scene, effect, true);
    if (!effect.macro.empty()) {
        std::vector<std::string_view> gained = pair->along;
        gained.push_back(effect.name);
        EXPECT_THAT(
            with.mask.without(without.mask).names(), testing::UnorderedElementsAreArray(gained));
        EXPECT_TRUE(with.mask.contains(without.mask));
    }
    expect_traces(*pair, without, with);
}

INSTANTIATE_TEST_SUITE_P(Registry, EffectTracesTest, testing::ValuesIn(effect_registry()),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace farlight
