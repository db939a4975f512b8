// Compiled programs kept on disk: what is there is used, and nothing that is wrong with an entry is
// ever more than a miss.
#include "server/gl/program_binaries.h"

#include "server/gl/context.h"
#include "server/gl/program.h"

#include <epoxy/gl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace farlight {
namespace {

namespace fs = std::filesystem;

class ProgramBinariesTest : public testing::Test {
protected:
    ProgramBinariesTest()
        : folder_(fs::temp_directory_path()
            / ("farlight-programs-" + std::to_string(getpid()) + "-"
                + testing::UnitTest::GetInstance()->current_test_info()->name()))
    {
        fs::remove_all(folder_);
    }
    ~ProgramBinariesTest() override { fs::remove_all(folder_); }

    static ShaderSource source(const std::string& text) { return {"test", text, {}}; }
    static ProgramBinary binary(std::size_t size, std::byte fill)
    {
        return {7, std::vector<std::byte>(size, fill)};
    }
    static std::string content(const fs::path& file)
    {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void write(const fs::path& file, const std::string& content)
    {
        std::ofstream(file, std::ios::binary) << content;
    }
    std::size_t files() const
    {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    const fs::path folder_;
    const ProgramBinaries cache_{folder_, "driver 1"};
};

TEST_F(ProgramBinariesTest, GivesBackWhatWasStored)
{
    EXPECT_FALSE(cache_.load(source("a"))) << "not even a folder";
    cache_.store(source("a"), binary(1000, std::byte{1}));
    cache_.store(source("b"), binary(10, std::byte{2}));
    const auto a = cache_.load(source("a"));
    ASSERT_TRUE(a);
    EXPECT_EQ(a->format, 7U);
    EXPECT_EQ(a->bytes, binary(1000, std::byte{1}).bytes);
    EXPECT_EQ(cache_.load(source("b"))->bytes.size(), 10U);
    EXPECT_EQ(files(), 2U) << "nothing unfinished is left";
}

TEST_F(ProgramBinariesTest, AnotherSourceOrDriverIsAMiss)
{
    cache_.store(source("#define FX_FOG 1\nvoid main() {}"), binary(10, std::byte{1}));
    EXPECT_FALSE(cache_.load(source("void main() {}")));
    const ProgramBinaries other(folder_, "driver 2");
    EXPECT_FALSE(other.load(source("#define FX_FOG 1\nvoid main() {}")));
}

TEST_F(ProgramBinariesTest, AForeignEntryUnderOurNameIsAMiss)
{
    cache_.store(source("a"), binary(10, std::byte{1}));
    cache_.store(source("b"), binary(10, std::byte{2}));
    write(cache_.file_of(source("a")), content(cache_.file_of(source("b"))));
    EXPECT_FALSE(cache_.load(source("a")));
    EXPECT_TRUE(cache_.load(source("b")));
}

/// Cut at every length, and every byte flipped: none is taken.
TEST_F(ProgramBinariesTest, EveryDamageIsAMiss)
{
    cache_.store(source("a"), binary(40, std::byte{1}));
    const fs::path file = cache_.file_of(source("a"));
    const std::string whole = content(file);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write(file, whole.substr(0, length));
        EXPECT_FALSE(cache_.load(source("a"))) << "cut to " << length;
    }
    write(file, whole + "x");
    EXPECT_FALSE(cache_.load(source("a"))) << "longer than it says";
    constexpr std::size_t kFormatAt = 40;  // the driver judges the format
    for (std::size_t at = 0; at < whole.size(); ++at) {
        if (at >= kFormatAt && at < kFormatAt + 8)
            continue;
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        write(file, damaged);
        EXPECT_FALSE(cache_.load(source("a"))) << "byte " << at;
    }
    write(file, whole);
    EXPECT_TRUE(cache_.load(source("a")));
}

TEST_F(ProgramBinariesTest, TheLeastRecentlyUsedGoWhenTheFolderIsFull)
{
    const ProgramBinaries small(folder_, "driver 1", 3500);
    for (const char* name : {"a", "b", "c"}) {
        small.store(source(name), binary(1000, std::byte{1}));
        // File times may be coarse: order them by hand.
        fs::last_write_time(small.file_of(source(name)),
            fs::file_time_type::clock::now() - std::chrono::hours(name[0] == 'a' ? 3 : 2));
    }
    EXPECT_TRUE(small.load(source("a"))) << "now the newest";
    small.store(source("d"), binary(1000, std::byte{1}));
    EXPECT_EQ(files(), 3U);
    EXPECT_TRUE(small.load(source("a")));
    EXPECT_TRUE(small.load(source("d")));
}

/// Two servers that store the same programs and others, in a folder too small for all: a reader
/// finds an entry whole or not at all, whoever wrote it last.
TEST_F(ProgramBinariesTest, TwoServersMayShareAFolder)
{
    constexpr std::size_t kBytes = 20'000;
    constexpr int kRounds = 200;
    const ProgramBinaries small(folder_, "driver 1", 5 * kBytes);
    const auto write_as = [&](std::byte fill, std::size_t bytes) {
        for (int i = 0; i < kRounds; ++i)
            small.store(source(std::to_string(i % 7)), binary(bytes, fill));
    };
    const pid_t other = fork();
    ASSERT_GE(other, 0);
    if (other == 0) {
        write_as(std::byte{2}, kBytes / 2);
        _exit(0);
    }
    int found = 0;
    for (int i = 0; i < kRounds; ++i) {
        small.store(source(std::to_string(i % 7)), binary(kBytes, std::byte{1}));
        if (const auto entry = small.load(source(std::to_string(i % 3)))) {
            ++found;
            ASSERT_FALSE(entry->bytes.empty());
            const std::byte fill = entry->bytes.front();
            EXPECT_EQ(entry->bytes, binary(fill == std::byte{1} ? kBytes : kBytes / 2, fill).bytes);
        }
    }
    int status = -1;
    ASSERT_EQ(waitpid(other, &status, 0), other);
    EXPECT_EQ(status, 0);
    EXPECT_GT(found, 0);
    small.store(source("last"), binary(kBytes, std::byte{1}));
    EXPECT_TRUE(small.load(source("last")));
    for (const auto& file : fs::directory_iterator(folder_))
        EXPECT_EQ(file.path().extension(), ".bin") << "unfinished: " << file.path();
}

TEST_F(ProgramBinariesTest, AFolderThatCannotBeWrittenHurtsNobody)
{
    write(folder_, "a file");
    cache_.store(source("a"), binary(10, std::byte{1}));
    EXPECT_FALSE(cache_.load(source("a")));
}

constexpr const char* kDouble = R"(#version 450
layout(local_size_x = 1) in;
layout(std430) buffer numbers { uint number; };
void main() { number *= 2u; }
)";

unsigned doubled(const Program& program, unsigned number)
{
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, sizeof number, &number, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, program.storage_blocks().at("numbers"), buffer);
    glUseProgram(program.id());
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, sizeof number, &number);
    glDeleteBuffers(1, &buffer);
    return number;
}

TEST_F(ProgramBinariesTest, ProgramsComeBackFromDisk)
{
    static const Context context("software");
    const Program compiled(source(kDouble), &cache_);
    EXPECT_EQ(doubled(compiled, 21), 42U);
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (formats == 0)
        GTEST_SKIP() << "this driver keeps no binaries";
    ASSERT_TRUE(cache_.load(source(kDouble)));
    const Program loaded(source(kDouble), &cache_);
    EXPECT_EQ(doubled(loaded, 21), 42U);

    // An entry that is whole but not of any driver: compiled, and replaced.
    cache_.store(source(kDouble), binary(100, std::byte{3}));
    const Program again(source(kDouble), &cache_);
    EXPECT_EQ(doubled(again, 21), 42U);
    EXPECT_NE(cache_.load(source(kDouble))->bytes, binary(100, std::byte{3}).bytes);
}

}  // namespace
}  // namespace farlight
