// The JSON messages of farlight.v1, as plain structs. PROTOCOL.md says what they mean; a test holds
// the two together.
//
// each_field is the one list of a message's fields: encoder, decoder and the test of the
// documentation use it. A std::optional, or a field whose Rule says so, may be absent; every other
// must be there. To add a message: a struct here with kType and each_field, its name in the
// variant, its section in PROTOCOL.md with an example.
#pragma once

#include "protocol/client_messages.h"
#include "protocol/server_messages.h"
