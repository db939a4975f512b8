// A synchronous Beast server in threads.
#include "tests/client/fake_server.h"

#include <atomic>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <cstring>
#include <gtest/gtest.h>
#include <random>

namespace farlight {

using namespace protocol;
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

ClientMessage FakePeer::read()
{
    beast::flat_buffer buffer;
    stream_.read(buffer);
    const std::string text = beast::buffers_to_string(buffer.data());
    auto decoded = decode_client_message(text);
    if (const auto* error = std::get_if<DecodeError>(&decoded)) {
        ADD_FAILURE() << text << ": " << to_string(*error);
        return ClientBye{};
    }
    return std::get<ClientMessage>(decoded);
}

void FakePeer::send_text(const std::string& text)
{
    stream_.text(true);
    stream_.write(asio::buffer(text));
}

void FakePeer::send_binary(const std::vector<std::byte>& bytes)
{
    stream_.binary(true);
    stream_.write(asio::buffer(bytes));
}

void FakePeer::send_frame(FrameHeader header, const std::vector<std::byte>& payload)
{
    header.payload_size = static_cast<std::uint32_t>(payload.size());
    std::vector<std::byte> message = encode_frame_header(header);
    message.insert(message.end(), payload.begin(), payload.end());
    send_binary(message);
}

void FakePeer::close(std::uint16_t code, const std::string& reason)
{
    stream_.close(websocket::close_reason(websocket::close_code(code), reason));
}

void FakePeer::drop()
{
    stream_.next_layer().close();
}

FakeServer::FakeServer(Handler handler, std::string subprotocol)
    : handler_(std::move(handler))
    , subprotocol_(std::move(subprotocol))
    , acceptor_(io_, {asio::ip::make_address("127.0.0.1"), 0})
    , port_(acceptor_.local_endpoint().port())
    , accepting_([this] { accept(); })
{
}

void FakeServer::accept()
{
    while (true) {
        boost::system::error_code error;
        asio::ip::tcp::socket socket(io_);
        acceptor_.accept(socket, error);
        if (error)
            return;
        connections_.emplace_back([this, accepted = std::move(socket)]() mutable {
            FakePeer::Stream stream(std::move(accepted));
            stream.set_option(
                websocket::stream_base::decorator([this](websocket::response_type& response) {
                    response.set(beast::http::field::sec_websocket_protocol, subprotocol_);
                }));
            try {
                stream.accept();
                FakePeer peer(stream);
                handler_(peer);
            } catch (const boost::system::system_error&) {  // the client has gone
            }
        });
    }
}

FakeServer::~FakeServer()
{
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);  // wakes the blocked accept
}

Welcome fake_welcome()
{
    Welcome welcome;
    welcome.server = "fake 1";
    welcome.session = "s1";
    welcome.device = "none";
    welcome.gl_renderer = "fake";
    welcome.size = {16, 8};
    welcome.scene = {.name = "Fake",
        .file = "fake.json",
        .notes = {"a note"},
        .bounds = BoundingBox{{-1, 0, -1}, {1, 2, 1}},
        .triangles = 2,
        .lights = 1};
    welcome.camera = {.position = {0, 1, 5}, .target = {0, 1, 0}};
    welcome.camera_paths["push"] = {
        {.frame = 0, .pose = welcome.camera}, {.frame = 4, .pose = welcome.camera}};
    welcome.camera_paths["push"][1].pose.position[2] = 1;
    welcome.settings = nlohmann::json::parse(
        R"([{"key":"seed","type":"integer","value":0,"default":0,"lower":0,"upper":9,"help":"same seed, same picture"},
            {"key":"effects","type":"text","value":"auto","default":"auto","help":"which programs"}])");
    welcome.limits.max_dimension = 1024;
    return welcome;
}

namespace {

/// One session of the fake renderer.
struct FakeSession {
    const FakeRenderer& renderer;
    Size size{};
    std::map<std::string, nlohmann::json> settings;
    std::vector<double> sum;
    std::uint32_t samples = 0;
    std::uint32_t frames = 0;

    double number(const std::string& key, double absent) const
    {
        const auto found = settings.find(key);
        return found != settings.end() && found->second.is_number() ? found->second.get<double>()
                                                                    : absent;
    }

    /// Of the views that scripts look at: a near wall before a far one gives way by 4 columns a
    /// frame.
    std::optional<std::vector<float>> draw_buffer() const
    {
        const auto view = settings.find("view");
        if (view == settings.end() || (view->second != "depth" && view->second != "motion"))
            return {};
        std::vector<float> values(std::size_t{3} * size[0] * size[1], 0.0F);
        for (std::size_t i = 0; view->second == "depth" && i < values.size(); ++i)
            values[i] = i / 3 % size[0] + std::size_t{4} * frames < size[0] ? 1.0F : 5.0F;
        return values;
    }

    std::vector<float> draw()
    {
        if (auto buffer = draw_buffer())
            return *buffer;
        static std::atomic<unsigned> unrepeatable{1000};
        const auto seed = static_cast<unsigned>(number("seed", 0));
        std::mt19937 random(renderer.ignores_seed ? unrepeatable++ : seed * 1000003U + frames);
        const std::string denoiser =
            settings.contains("denoiser") ? settings["denoiser"].get<std::string>() : "none";
        const auto spp = static_cast<unsigned>(number("samples_per_pixel", 1));
        sum.resize(std::size_t{3} * size[0] * size[1]);
        std::vector<float> pixels(sum.size());
        samples = denoiser == "accumulate" ? samples + spp : spp;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            double drawn = 0;
            for (unsigned s = 0; s < spp; ++s)
                drawn += std::uniform_real_distribution<double>(0, 2)(random);
            sum[i] += drawn;
            const double fresh = drawn / spp;
            pixels[i] = static_cast<float>(denoiser == "accumulate" ? sum[i] / samples
                    : denoiser == "svgf"                            ? 1 + 0.1 * (fresh - 1)
                                                                    : fresh);
        }
        if (static_cast<int>(frames) == renderer.nan_in_frame)
            pixels[0] = std::numeric_limits<float>::quiet_NaN();
        return pixels;
    }

    void answer(FakePeer& peer, const Camera& camera)
    {
        const std::vector<float> pixels = draw();
        FrameHeader header{.format = Format::kRaw,
            .frame_id = ++frames,
            .camera_sequence = camera.sequence,
            .session_epoch = 1,
            .width = static_cast<std::uint16_t>(size[0]),
            .height = static_cast<std::uint16_t>(size[1]),
            .accumulated_samples = samples,
            .trace_us = 1500};
        header.flags = frames == 1 || camera.cut ? frame_flags::kHistoryReset : 0;
        header.passes = {{"path_trace", 1.5F}};
        std::vector<std::byte> payload(pixels.size() * sizeof(float));
        std::memcpy(payload.data(), pixels.data(), payload.size());
        peer.send_frame(header, payload);
    }

    /// Fog is all that the scene calls for; its own programs come late.
    Inspection inspection() const
    {
        const auto asked = settings.find("effects");
        const bool compiled = frames > renderer.own_after;
        const bool general = asked == settings.end() || asked->second == "auto"
            ? !compiled
            : asked->second == "general";
        Inspection inspection{.effects = {{"fog", "medium 'haze'", ""},
                                  {"denoising", "setting denoiser = svgf", "denoiser"}},
            .program = {"fog", "denoising"},
            .constants = {{"BVH_STACK_SIZE", 9}},
            .general = general,
            .passes = {"path_trace"},
            .scene_memory = {{"bvh_nodes", 1024}, {"texture_array_0", 40}, {"texture_array_1", 60}},
            .view_memory = {{"gbuffer", 2048}},
            .compile_ms = compiled ? 250.0 : 0.0};
        if (general)
            inspection.program.emplace_back("lens");
        return inspection;
    }
};

}  // namespace

void serve_lockstep(FakePeer& peer, const FakeRenderer& renderer)
{
    const auto hello = std::get<Hello>(peer.read());
    Welcome welcome = fake_welcome();
    welcome.size = hello.size.value_or(welcome.size);
    welcome.format = Format::kRaw;
    if (hello.settings.contains(renderer.refuses_setting))
        peer.send(Error{.code = ErrorCode::kUnknownSetting,
            .message = "setting '" + renderer.refuses_setting + "' is unknown",
            .field = renderer.refuses_setting});
    peer.send(welcome);
    FakeSession session{
        .renderer = renderer, .size = welcome.size, .settings = hello.settings, .sum = {}};
    while (true) {
        const ClientMessage message = peer.read();
        if (const auto* camera = std::get_if<Camera>(&message)) {
            session.answer(peer, *camera);
        } else if (const auto* set = std::get_if<Set>(&message)) {
            session.settings[set->key] = set->value;
            peer.send(
                State{.settings = session.settings, .size = session.size, .format = Format::kRaw});
        } else if (const auto* edit = std::get_if<Edit>(&message)) {
            if (edit->patch.contains("bad"))
                peer.send(Error{.code = ErrorCode::kEditRefused,
                    .message = "fake.json: /bad: found 1, expected nothing",
                    .field = "/bad"});
            else
                peer.send(SceneChanged{edit->id, welcome.scene, {}});
        } else if (std::holds_alternative<Inspect>(message)) {
            peer.send(session.inspection());
        } else if (std::holds_alternative<ClientBye>(message)) {
            return peer.close(1000, "");
        }
    }
}

}  // namespace farlight
