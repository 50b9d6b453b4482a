#include "geometry/piece.h"

#include "base/union_find.h"

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

// Copies the mirror images within a piece; those of free vertices all lie in it.
void copy_partners(const IndexVector& partner, std::vector<int>& local, Piece& piece) {
  const int n = static_cast<int>(piece.vertex.size());
  for (int v = 0; v < n; ++v) local[piece.vertex[v]] = v;
  piece.partner.resize(n);
  for (int v = 0; v < n; ++v) {
    const int other = partner(piece.vertex[v]);
    piece.partner(v) = other < 0 ? -1 : local[other];
  }
  for (int v : piece.vertex) local[v] = -1;
}

// Numbers the parts of a piece by their first triangles.
void number_parts(const HeightField& whole, const std::vector<int>& triangles, std::vector<int>& part, Piece& piece) {
  for (const int t : triangles) {
    int& name = part[whole.piece[t]];
    if (name < 0) name = piece.field.piece_count++;
    piece.field.piece.push_back(name);
  }
}

// Returns the group of each of the field's pieces: pieces with mirror images of each other's free vertices are in one.
// Groups are numbered by their first pieces.
std::vector<int> group_pieces(const HeightField& field, const IndexVector& partner, int& count) {
  UnionFind coupled(field.piece_count);
  std::vector<int> piece(field.vertex_count(), -1);
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (const int v : field.F.row(t)) piece[v] = field.piece[t];  // free vertices lie in one piece each
  }
  for (int v = 0; v < partner.size(); ++v) {
    if (field.role[v] == VertexRole::kFree && partner(v) >= 0) coupled.unite(piece[v], piece[partner(v)]);
  }
  std::vector<int> group(field.piece_count, -1);
  count = 0;
  for (int k = 0; k < field.piece_count; ++k) group[k] = coupled.find(k) == k ? count++ : group[coupled.find(k)];
  return group;
}

}  // namespace

std::vector<Piece> split_pieces(const HeightField& field, const IndexVector& partner) {
  int count = 0;
  const std::vector<int> group = group_pieces(field, partner, count);
  std::vector<std::vector<int>> triangles(count);
  std::vector<int> number(field.triangle_count());  // index of each triangle within its piece
  for (int t = 0; t < field.triangle_count(); ++t) {
    std::vector<int>& own = triangles[group[field.piece[t]]];
    number[t] = static_cast<int>(own.size());
    own.push_back(t);
  }
  std::vector<int> local(field.vertex_count(), -1), part(field.piece_count, -1);
  std::vector<Piece> pieces(count);
  for (int k = 0; k < count; ++k) {
    Piece& piece = pieces[k];
    number_vertices(field, triangles[k], local, piece);
    copy_vertices(field, piece);
    if (partner.size() > 0) copy_partners(partner, local, piece);
    piece.field.area.resize(piece.field.triangle_count());
    for (int t = 0; t < piece.field.triangle_count(); ++t) {
      piece.field.source.push_back(field.source[triangles[k][t]]);
      piece.field.area(t) = field.area(triangles[k][t]);
    }
    copy_neighbors(field, triangles[k], number, piece);
    piece.field.triangles_of_vertex = vertex_triangles(piece.field.F, piece.field.vertex_count());
    number_parts(field, triangles[k], part, piece);
  }
  return pieces;
}

}  // namespace reflines
