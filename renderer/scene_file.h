// SPDX-License-Identifier: MIT
// Models from files as scenes: whatever Assimp reads (glTF, OBJ, PLY and more), put on a ground,
// with a camera, a light and a softness that suit its size. Geometry and plain colours alone: no
// textures, bones or lights of the file's own.
#pragma once

#include <filesystem>
#include <string_view>

#include "renderer/scene.h"

namespace renderer {

/// The longest edge of a model's bounds as it stands in the scene, m: files do not say their unit.
inline constexpr float kModelSizeM = 3;

/// Throws std::runtime_error that names the file and what is wrong with it: missing, not a file,
/// not readable as a model, cut short, without triangles, or with corners that are no numbers or
/// all in one place. What of it was left out is in the scene's notes.
Scene loadScene(const std::filesystem::path& file);

/// Whether a source has a dot or a slash and is no built-in scene's name.
bool isModelFile(std::string_view source);

/// The part of a source that names the scene: what is behind it are options. Of a model the longest
/// part up to a colon that is a file, so a colon may be in its name; where none is, all but what
/// looks like options.
std::string_view withoutOptions(std::string_view source);

/// A built-in scene as makeScene() takes it, or a model file with such options behind it. Throws
/// what makeScene(), loadScene() and applyOptions() throw.
Scene openScene(std::string_view source);

}  // namespace renderer
