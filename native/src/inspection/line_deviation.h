// Measures how far the lines of a height field are from their course, in many lights from many views.
#pragma once

#include "geometry/height_field.h"
#include "reflines/types.h"
#include "restoration/disk_mean.h"

namespace reflines {

// The deviations of all triangles of a field, by place: see PanelInspection.
struct LineDeviation {
  Eigen::MatrixXd degrees;  // #views x #lights
  Vector seen;              // #views: fraction of the area
  Vector worst;             // #T: degrees
  IndexVector view, light;  // #T
  IndexVector front_light;  // #T: the one in which that from the first view is most
  Eigen::MatrixXf maps;     // #T x #views #lights, or nothing
};

// Compares lines pair by pair, so that the memory needed does not grow with the number of lights and views.
class DeviationSum {
 public:
  // `course` (#T x 2) are the slopes without flaws; the deviation at a place is the mean over a disk of this radius.
  // The field and the frame outlive this.
  DeviationSum(const HeightField& field, const ImagePlane& frame, PlaneVectors course, double radius, bool keeps_maps);

  // Adds a view, in those of the lights (#lights x 3) that count (#lights); `weight` (#T) says how well it sees each
  // triangle, 0 to 1.
  void add_view(const Vector3& view, const Positions& lines, const Eigen::ArrayX<bool>& counts, const Vector& weight);

  const LineDeviation& result() const { return result_; }

 private:
  void keep_map(const Eigen::MatrixXd& mean);

  const HeightField& field_;
  const ImagePlane& frame_;
  PlaneVectors slope_, course_slope_;  // #T x 2
  DiskMean around_;
  bool keeps_maps_;
  LineDeviation result_;
};

}  // namespace reflines
