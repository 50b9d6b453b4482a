#include "geometry/piece.h"

namespace reflines {
namespace {

void number_vertices(const HeightField& whole, const std::vector<int>& triangles, std::vector<int>& local,
                     Piece& piece) {
  piece.field.F.resize(static_cast<int>(triangles.size()), 3);
  for (size_t k = 0; k < triangles.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      int& name = local[whole.F(triangles[k], i)];
      if (name < 0) {
        name = static_cast<int>(piece.vertex.size());
        piece.vertex.push_back(whole.F(triangles[k], i));
      }
      piece.field.F(static_cast<int>(k), i) = name;
    }
  }
  for (int v : piece.vertex) local[v] = -1;
}

void copy_vertices(const HeightField& whole, Piece& piece) {
  const int n = static_cast<int>(piece.vertex.size());
  piece.field.xy.resize(n, 2);
  piece.field.z.resize(n);
  for (int v = 0; v < n; ++v) {
    piece.field.xy.row(v) = whole.xy.row(piece.vertex[v]);
    piece.field.z(v) = whole.z(piece.vertex[v]);
    piece.field.role.push_back(whole.role[piece.vertex[v]]);
    piece.free_count += piece.field.role.back() == VertexRole::kFree;
  }
}

// Copies the neighbours within a piece, so that creases, which are cut in the whole field, stay cut.
void copy_neighbors(const HeightField& whole, const std::vector<int>& triangles, const std::vector<int>& number,
                    Piece& piece) {
  piece.field.neighbors.resize(static_cast<int>(triangles.size()), 3);
  for (size_t k = 0; k < triangles.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      const int other = whole.neighbors(triangles[k], i);
      piece.field.neighbors(static_cast<int>(k), i) = other < 0 ? -1 : number[other];
    }
  }
}

}  // namespace

std::vector<Piece> split_pieces(const HeightField& field) {
  std::vector<std::vector<int>> triangles(field.piece_count);
  std::vector<int> number(field.triangle_count());  // index of each triangle within its piece
  for (int t = 0; t < field.triangle_count(); ++t) {
    number[t] = static_cast<int>(triangles[field.piece[t]].size());
    triangles[field.piece[t]].push_back(t);
  }
  std::vector<int> local(field.vertex_count(), -1);
  std::vector<Piece> pieces(field.piece_count);
  for (int k = 0; k < field.piece_count; ++k) {
    Piece& piece = pieces[k];
    number_vertices(field, triangles[k], local, piece);
    copy_vertices(field, piece);
    piece.field.area.resize(piece.field.triangle_count());
    for (int t = 0; t < piece.field.triangle_count(); ++t) {
      piece.field.source.push_back(field.source[triangles[k][t]]);
      piece.field.area(t) = field.area(triangles[k][t]);
    }
    copy_neighbors(field, triangles[k], number, piece);
    piece.field.triangles_of_vertex = vertex_triangles(piece.field.F, piece.field.vertex_count());
    piece.field.piece.assign(triangles[k].size(), 0);
    piece.field.piece_count = 1;
  }
  return pieces;
}

}  // namespace reflines
