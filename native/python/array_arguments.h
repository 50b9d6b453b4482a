// Checked conversion of arrays of numbers from Python. pybind11's own caster for Eigen answers an array of another
// shape with a TypeError that lists the signature; these throw InvalidInput with the shape that was given. Include this
// header, never pybind11/eigen.h alone: all files must see the same casters.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <string>
#include <utility>

#include "reflines/errors.h"
#include "reflines/types.h"

namespace reflines {

// Throws InvalidInput: an array of other numbers or of another shape was given where `wanted` is needed.
[[noreturn]] void refuse_array(const pybind11::array& given, const char* wanted);

// Returns whether numpy's numbers of this kind can stand for real ones.
inline bool holds_reals(const pybind11::array& given) {
  const char kind = given.dtype().kind();
  return kind == 'f' || kind == 'i' || kind == 'u' || kind == 'b';
}

// Converts an array whose rows (or, of a vector, whose entries) are read in order. `kWanted` says what is needed.
template <typename Type>
struct ArrayCaster {
  using Scalar = typename Type::Scalar;
  static constexpr bool kFlat = Type::ColsAtCompileTime == 1;
  static constexpr auto name = pybind11::detail::const_name("numpy.ndarray");  // NOLINT: a caster's name for this
  template <typename To>
  using cast_op_type = pybind11::detail::movable_cast_op_type<To>;  // NOLINT: likewise

  // These conversions are part of the interface of a caster.
  operator Type*() { return &value_; }                // NOLINT
  operator Type&() { return value_; }                 // NOLINT
  operator Type&&() && { return std::move(value_); }  // NOLINT

  // Returns false where another function of the same name may fit: pybind11 tries all of them without conversion first.
  bool load_as(pybind11::handle source, bool convert, const char* wanted) {
    namespace py = pybind11;
    if (source.is_none() || py::isinstance<py::str>(source)) return false;
    const py::array given = py::array::ensure(source);
    if (!given) return false;
    if (!holds_reals(given) || !fits(given)) {
      if (!convert) return false;
      refuse_array(given, wanted);
    }
    const auto numbers = py::array_t<Scalar, py::array::c_style | py::array::forcecast>::ensure(given);
    const Eigen::Index rows = given.shape(0);
    using Rows =
        Eigen::Matrix<Scalar, Eigen::Dynamic, Type::ColsAtCompileTime, kFlat ? Eigen::ColMajor : Eigen::RowMajor>;
    value_ = Eigen::Map<const Rows>(numbers.data(), rows, Type::ColsAtCompileTime);
    return true;
  }

  static pybind11::handle cast(Type&& source, pybind11::return_value_policy, pybind11::handle) {
    using Props = pybind11::detail::EigenProps<Type>;
    return pybind11::detail::eigen_encapsulate<Props>(new Type(std::move(source)));
  }
  static pybind11::handle cast(const Type& source, pybind11::return_value_policy, pybind11::handle) {
    return pybind11::detail::eigen_array_cast<pybind11::detail::EigenProps<Type>>(source);
  }

 private:
  static bool fits(const pybind11::array& given) {
    if (given.ndim() != (kFlat ? 1 : 2)) return false;
    if (!kFlat) return given.shape(1) == Type::ColsAtCompileTime;
    return Type::RowsAtCompileTime == Eigen::Dynamic || given.shape(0) == Type::RowsAtCompileTime;
  }

  Type value_;
};

}  // namespace reflines

namespace pybind11::detail {

template <>
struct type_caster<reflines::Positions> : reflines::ArrayCaster<reflines::Positions> {
  bool load(handle source, bool convert) { return load_as(source, convert, "rows of three numbers"); }
};

template <>
struct type_caster<reflines::PlanePositions> : reflines::ArrayCaster<reflines::PlanePositions> {
  bool load(handle source, bool convert) { return load_as(source, convert, "rows of two numbers"); }
};

template <>
struct type_caster<reflines::Vector3> : reflines::ArrayCaster<reflines::Vector3> {
  bool load(handle source, bool convert) { return load_as(source, convert, "three numbers"); }
};

template <>
struct type_caster<reflines::Vector2> : reflines::ArrayCaster<reflines::Vector2> {
  bool load(handle source, bool convert) { return load_as(source, convert, "two numbers"); }
};

template <>
struct type_caster<reflines::Vector> : reflines::ArrayCaster<reflines::Vector> {
  bool load(handle source, bool convert) { return load_as(source, convert, "numbers in a row"); }
};

template <>
struct type_caster<reflines::Mask> : reflines::ArrayCaster<reflines::Mask> {
  bool load(handle source, bool convert) { return load_as(source, convert, "truth values in a row"); }
};

}  // namespace pybind11::detail
