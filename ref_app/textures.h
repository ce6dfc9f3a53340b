// The textures of the scenes, computed. All tile without a seam, and are smooth from texel to texel: a
// comparison of two renderers' pictures shall measure the renderers, not the noise of the texture.
#pragma once

#include "ref_app/gapi.h"

namespace ref_app {

inline constexpr int kTextureSize = 256;

Image make_brick();
Image make_wood();
Image make_marble();
Image make_checker();

}  // namespace ref_app
