// A remedy for llvmpipe, which would compile most programs twice.
#pragma once

namespace farlight {

/// Gives every sampler slot of the current context the state that our textures give it.
///
/// llvmpipe compiles a program for the sampler states it is dispatched with, and a slot that holds
/// a buffer texture keeps the state of whatever was bound there before: nothing in the first frame,
/// another pass's texture in later ones. Two states, two compilations (seconds each for the path
/// tracer, measured on Mesa 22.3.6). After one dispatch that fills all slots there is one state.
void settle_sampler_slots();

}  // namespace farlight
