// Frames a program drew, as our library left them: frame_00000.ppm, frame_00001.ppm, ... (HALFSPACE_CAPTURE).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace halfspace::compare {

// The frame_*.EXTENSION files of `folder`, in order; none when it does not exist.
std::vector<std::filesystem::path> captured_frames(const std::filesystem::path& folder,
                                                   const std::string& extension);

// Turns every frame_*.ppm of `folder` into `format` ("png", "bmp", ...) and removes the original, unless
// `format` is "ppm". Returns how many frames there are. Throws ImageError.
size_t convert_frames(const std::filesystem::path& folder, const std::string& format);

}  // namespace halfspace::compare
