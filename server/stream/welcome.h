// What the wire says about renderer and scene: description and settings to messages, poses both
// ways.
#pragma once

#include "protocol/messages.h"
#include "server/render/renderer.h"

namespace farlight {

CameraPose pose_from_wire(const protocol::Pose& pose);
protocol::Pose pose_to_wire(const CameraPose& pose);

/// The parts of `welcome` that are the same for every session.
protocol::Welcome describe_server(const RendererDescription& description);

/// Every setting's value by key, as in `state`.
std::map<std::string, nlohmann::json> setting_values(const RenderSettings& settings);

bool is_setting(std::string_view key);

}  // namespace farlight
