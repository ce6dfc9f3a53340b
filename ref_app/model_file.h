#pragma once

#include <string>

#include "ref_app/teapot.h"

namespace ref_app {

// Reads a Wavefront OBJ file to stand in the teapot's place: scaled and moved to the teapot's size, on y = 0,
// with the light baked in as `look` says. Normals are computed where the file has none. Throws InputError.
Geometry load_model(const std::string& path, const TeapotLook& look);

}  // namespace ref_app
