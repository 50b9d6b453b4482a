#include "reflines/subdivision.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <future>
#include <memory>
#include <string>
#include <utility>

#include "geometry/mask_room.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
using Refiner = std::unique_ptr<Far::TopologyRefiner>;
using StencilTable = Far::StencilTableReal<double>;

constexpr double kMaxFaces = 8e6;
constexpr double kParallel = 1e-8;   // a sine; on a car with slivers and doubled faces none is between 1e-4 and 1e-13
constexpr double kRoundOff = 1e-15;  // weights are of order 1: smaller ones are cancelled sums

constexpr int kRowsAtOnce = 4096;  // chunk of work between two checks for cancellation: some milliseconds

void check_options(const Cage& cage, const SubdivisionOptions& options) {
  if (options.level < 1 || options.level > kMaxSubdivisionLevel) {
    throw InvalidInput("The subdivision level is " + std::to_string(options.level) + ": choose one from 1 to " +
                       std::to_string(kMaxSubdivisionLevel) + ".");
  }
  const int corners = static_cast<int>(cage.face_vertices.size());
  const int faces = static_cast<int>(cage.face_offsets.size()) - 1;
  const bool loop = options.scheme == SubdivisionScheme::kLoop;
  const IndexVector sizes = cage.face_offsets.tail(faces) - cage.face_offsets.head(faces);
  const int others = static_cast<int>((sizes.array() != 3).count());
  if (loop && others > 0) {
    throw InvalidInput("Loop subdivision needs triangles but " + std::to_string(others) +
                       " faces are none: triangulate the cage or use Catmull-Clark.");
  }
  if (cage.vertices > kMaxFaces) {
    throw InvalidInput("The cage has " + std::to_string(cage.vertices) + " vertices, more than " +
                       std::to_string(static_cast<int>(kMaxFaces / 1e6)) + " million: leave out those of no face.");
  }
  const double refined = (loop ? 4.0 * faces : corners) * std::pow(4.0, options.level - 1);
  if (refined <= kMaxFaces) return;
  throw InvalidInput("Level " + std::to_string(options.level) + " of this cage has " +
                     std::to_string(static_cast<int>(refined / 1e6)) + " million faces, more than " +
                     std::to_string(static_cast<int>(kMaxFaces / 1e6)) + " million: choose a lower level.");
}

// The arrays that OpenSubdiv's descriptor points to.
struct Tags {
  std::vector<int> face_sizes;
  std::vector<float> crease_sharpness;
  std::vector<int> corners;
  std::vector<float> corner_sharpness;
};

// Returns the sharpness of vertices as Blender computes it: a vertex with exactly two edges (the corner of a sheet) is
// as sharp as the softer of them, in addition to its own sharpness. Without this, creases along a border do not keep
// its corner.
Vector vertex_sharpness(const Cage& cage) {
  Vector sharpness = Vector::Zero(cage.vertices);
  for (int i = 0; i < cage.corners.size(); ++i) sharpness[cage.corners[i]] = cage.corner_sharpness[i];
  IndexVector valence = IndexVector::Zero(cage.vertices), creased = valence;
  for (const CageEdge& edge : cage_edges(cage)) ++valence[edge.first], ++valence[edge.second];
  Vector softer = Vector::Constant(cage.vertices, kSharp);
  for (int c = 0; c < cage.creases.rows(); ++c) {
    for (const int v : cage.creases.row(c)) {
      ++creased[v];
      softer[v] = std::min(softer[v], cage.crease_sharpness[c]);
    }
  }
  for (int v = 0; v < cage.vertices; ++v) {
    if (valence[v] == 2 && creased[v] == 2) sharpness[v] += softer[v];
  }
  return sharpness.cwiseMin(kSharp);
}

Tags make_tags(const Cage& cage) {
  Tags tags;
  const int faces = static_cast<int>(cage.face_offsets.size()) - 1;
  for (int f = 0; f < faces; ++f) tags.face_sizes.push_back(cage.face_offsets[f + 1] - cage.face_offsets[f]);
  for (const double sharpness : cage.crease_sharpness) {
    tags.crease_sharpness.push_back(static_cast<float>(std::min(sharpness, kSharp)));
  }
  const Vector sharpness = vertex_sharpness(cage);
  for (int v = 0; v < cage.vertices; ++v) {
    if (sharpness[v] == 0) continue;
    tags.corners.push_back(v);
    tags.corner_sharpness.push_back(static_cast<float>(sharpness[v]));
  }
  return tags;
}

Far::TopologyDescriptor describe(const Cage& cage, const Tags& tags) {
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = cage.vertices;
  descriptor.numFaces = static_cast<int>(tags.face_sizes.size());
  descriptor.numVertsPerFace = tags.face_sizes.data();
  descriptor.vertIndicesPerFace = cage.face_vertices.data();
  descriptor.numCreases = static_cast<int>(cage.creases.rows());
  descriptor.creaseVertexIndexPairs = cage.creases.data();
  descriptor.creaseWeights = tags.crease_sharpness.data();
  descriptor.numCorners = static_cast<int>(tags.corners.size());
  descriptor.cornerVertexIndices = tags.corners.data();
  descriptor.cornerWeights = tags.corner_sharpness.data();
  return descriptor;
}

// Refines uniformly, though adaptive refinement with limit stencils is faster: patches give the limit only, so that
// faces and refined positions need the uniform levels all the same, and they deviate from it, by 4e-3 of the size at
// the smooth corner of a sheet, where uniform refinement does not.
Refiner refine(const Cage& cage, const SubdivisionOptions& options) {
  Sdc::Options rules;
  rules.SetCreasingMethod(Sdc::Options::CREASE_UNIFORM);
  rules.SetVtxBoundaryInterpolation(options.boundary == SubdivisionBoundary::kAll
                                        ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                        : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  const auto scheme = options.scheme == SubdivisionScheme::kLoop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
  const Tags tags = make_tags(cage);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  Refiner refiner(Factory::Create(describe(cage, tags), Factory::Options(scheme, rules)));
  if (!refiner)
    throw InvalidInput("OpenSubdiv cannot connect the cage's faces: look for doubled faces and delete them.");
  Far::TopologyRefiner::UniformOptions uniform(options.level);
  uniform.fullTopologyInLastLevel = true;  // limit masks need the neighbours of the last level's vertices
  refiner->RefineUniform(uniform);
  return refiner;
}

// The positions of the last level's vertices: one row for each vertex, not sorted by column.
struct RefinedRows {
  explicit RefinedRows(const Far::TopologyRefiner& refiner);

  std::unique_ptr<const StencilTable> table;
  std::vector<int> starts;
  Eigen::Map<const RowMatrix> matrix;  // #refined x #V, on the table's arrays
};

std::unique_ptr<const StencilTable> last_level(const Far::TopologyRefiner& refiner) {
  Far::StencilTableFactoryReal<double>::Options options;
  options.generateIntermediateLevels = false;
  return std::unique_ptr<const StencilTable>(Far::StencilTableFactoryReal<double>::Create(refiner, options));
}

// Returns the start of each row, summed from the sizes, since the table's arrays end in unused zeros.
std::vector<int> row_starts(const StencilTable& table) {
  std::vector<int> starts{0};
  for (const int size : table.GetSizes()) starts.push_back(starts.back() + size);
  return starts;
}

RefinedRows::RefinedRows(const Far::TopologyRefiner& refiner)
    : table(last_level(refiner)),
      starts(row_starts(*table)),
      matrix(table->GetNumStencils(), table->GetNumControlVertices(), starts.back(), starts.data(),
             table->GetControlIndices().data(), table->GetWeights().data()) {}

// A value to "interpolate", by which OpenSubdiv exposes the masks themselves.
struct Index {
  int value;
};

// Receives one mask for each refined vertex: rows of (refined vertex, weight) in consecutive memory.
class Masks {
 public:
  explicit Masks(int rows) : begin_(rows), end_(rows) { terms_.reserve(9 * static_cast<size_t>(rows)); }
  Masks& operator[](int row) {
    row_ = row;
    return *this;
  }
  // Implement the interface of OpenSubdiv, whose names these are.
  void Clear() {  // NOLINT(readability-identifier-naming)
    begin_[row_] = end_[row_] = static_cast<int>(terms_.size());
  }
  void AddWithWeight(const Index& source, double weight) {  // NOLINT(readability-identifier-naming)
    terms_.emplace_back(source.value, weight);
    end_[row_] = static_cast<int>(terms_.size());
  }
  void drop(int row) { end_[row] = begin_[row]; }
  SparseMatrix times(const RefinedRows& refined, const Progress* progress) const;

 private:
  std::vector<std::pair<int, double>> terms_;
  std::vector<int> begin_, end_;
  int row_ = 0;
};

// Multiplies the masks by the rows. Eigen's product sorts every row and takes three times as long; here the change of
// storage order sorts them all.
SparseMatrix Masks::times(const RefinedRows& rows, const Progress* progress) const {
  const auto& refined = rows.matrix;
  std::vector<double> weights, sum(refined.cols(), 0.0);
  std::vector<int> columns, starts{0}, owner(refined.cols(), -1);
  weights.reserve(refined.nonZeros());
  columns.reserve(refined.nonZeros());
  for (int row = 0; row < refined.rows(); ++row) {
    if (row % kRowsAtOnce == 0) throw_if_cancelled(progress);
    for (int t = begin_[row]; t < end_[row]; ++t) {
      for (Eigen::Map<const RowMatrix>::InnerIterator it(refined, terms_[t].first); it; ++it) {
        const int column = static_cast<int>(it.col());
        if (owner[column] != row) columns.push_back(column), owner[column] = row;
        sum[column] += terms_[t].second * it.value();
      }
    }
    int kept = starts.back();
    for (int k = kept; k < static_cast<int>(columns.size()); ++k) {
      const double weight = std::exchange(sum[columns[k]], 0.0);
      if (std::abs(weight) < kRoundOff) continue;
      columns[kept++] = columns[k];
      weights.push_back(weight);
    }
    columns.resize(kept);
    starts.push_back(kept);
  }
  return Eigen::Map<const RowMatrix>(refined.rows(), refined.cols(), static_cast<int>(weights.size()), starts.data(),
                                     columns.data(), weights.data());
}

void set_positions(const Far::TopologyRefiner& refiner, const RefinedRows& refined, bool limit,
                   const Progress* progress, Subdivision* result) {
  const Far::TopologyLevel last = refiner.GetLevel(refiner.GetMaxLevel());
  const int size = static_cast<int>(refined.matrix.rows());
  std::vector<Index> source(size);
  for (int i = 0; i < size; ++i) source[i].value = i;
  Masks position(size), tangent_u(size), tangent_v(size);
  Far::PrimvarRefinerReal<double>(refiner).Limit(source, position, tangent_u, tangent_v);
  for (int v = 0; v < size; ++v) {
    // OpenSubdiv 3.5 gives masks there that do not sum to 0: they would turn the normals of a moved object.
    if (last.IsVertexNonManifold(v)) tangent_u.drop(v), tangent_v.drop(v);
  }
  auto u = std::async(std::launch::async, [&] { return tangent_u.times(refined, progress); });
  auto v = std::async(std::launch::async, [&] { return tangent_v.times(refined, progress); });
  result->positions = limit ? position.times(refined, progress) : SparseMatrix(refined.matrix);
  result->tangent_u = u.get();
  result->tangent_v = v.get();
}

void set_faces(const Far::TopologyRefiner& refiner, Subdivision* result) {
  const Far::TopologyLevel last = refiner.GetLevel(refiner.GetMaxLevel());
  const int corners = last.GetFaceVertices(0).size();
  result->faces.resize(last.GetNumFaces(), corners);
  for (int f = 0; f < last.GetNumFaces(); ++f) {
    for (int i = 0; i < corners; ++i) result->faces(f, i) = last.GetFaceVertices(f)[i];
  }
  IndexVector parent =
      IndexVector::LinSpaced(refiner.GetLevel(0).GetNumFaces(), 0, refiner.GetLevel(0).GetNumFaces() - 1);
  for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
    IndexVector child(refiner.GetLevel(level).GetNumFaces());
    Far::PrimvarRefinerReal<double>(refiner).InterpolateFaceUniform(level, parent, child);
    parent = child;
  }
  result->face_parent = parent;
}

}  // namespace

Subdivision subdivide(const Cage& cage, const SubdivisionOptions& options, const Progress* progress) {
  check_cage(cage);
  check_options(cage, options);
  if (options.scheme == SubdivisionScheme::kCatmullClark) check_mask_room(cage);
  const Refiner refiner = refine(cage, options);
  throw_if_cancelled(progress);
  Subdivision result;
  set_positions(*refiner, RefinedRows(*refiner), options.limit, progress, &result);
  throw_if_cancelled(progress);
  set_faces(*refiner, &result);
  return result;
}

Positions limit_normals(const Subdivision& subdivision, const Positions& cage_positions) {
  const Positions u = subdivision.tangent_u * cage_positions, v = subdivision.tangent_v * cage_positions;
  const double rounding = 1e-14 * cage_positions.cwiseAbs().maxCoeff();
  Positions normals(u.rows(), 3);
  for (int i = 0; i < u.rows(); ++i) {
    const Vector3 cross = u.row(i).cross(v.row(i));
    const double length = cross.norm();
    const double longest = std::max(u.row(i).norm(), v.row(i).norm());
    const bool parallel = length <= kParallel * longest * longest || longest <= rounding;
    normals.row(i) = parallel ? Vector3::UnitZ() : Vector3(cross / length);
  }
  return normals;
}

}  // namespace reflines
