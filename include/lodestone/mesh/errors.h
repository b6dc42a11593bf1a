// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace lodestone {

/// Base of every error that Lodestone throws. `what()` is one line: what, where, and what was expected,
/// such as `teapot.obj:812: face refers to vertex 9001 of 3241`.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A mesh, in a file or in memory, that cannot be used: broken file, non-triangle face, non-finite coordinate.
class Bad_mesh : public Error {
 public:
  using Error::Error;
};

/// A motion that is broken or does not fit its mesh: point cache, mesh sequence, deformation.
class Bad_motion : public Error {
 public:
  using Error::Error;
};

/// A scene file that is not a scene: syntax, unknown key, wrong type, path outside the scene's folder.
class Bad_scene : public Error {
 public:
  using Error::Error;
};

/// What was saved of an object, and cannot be used: broken bytes, another format, another mesh or another mode.
class Bad_saved_object : public Error {
 public:
  using Error::Error;
};

/// A vertex that is not where a bound of its motion, or a promise of the caller, says.
class Broken_bound : public Error {
 public:
  using Error::Error;
};

/// An argument or option outside its documented range.
class Bad_argument : public Error {
 public:
  using Error::Error;
};

/// A result that could not be written: missing folder, no permission, full disk.
class Bad_output : public Error {
 public:
  using Error::Error;
};

}  // namespace lodestone
