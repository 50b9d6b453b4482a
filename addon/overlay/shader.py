"""The stripes' shader. theta here is theta of the solver (paper, eq. 1), evaluated in every pixel."""
import gpu

STRUCT = """
struct StripeData {
  mat4 mvp; mat4 model; mat4 normals;
  vec4 depth_axis; vec4 eye; vec4 v_a; vec4 a_perp; vec4 shape; vec4 color; vec4 gap_color; vec4 opacity;
};
"""

VERTEX = """
void main()
{
  vec4 clip = ub.mvp * vec4(pos, 1.0);
  // z is taken as if the point were nearer to the eye by a share of its distance; x and y stay.
  vec4 nearer = clip + ub.depth_axis * (ub.shape.w * (ub.depth_axis.w != 0.0 ? clip.w : 1.0));
  gl_Position = vec4(clip.xy, nearer.z / nearer.w * clip.w, clip.w);
  world = (ub.model * vec4(pos, 1.0)).xyz;
  normal = (ub.normals * vec4(nor, 0.0)).xyz;
}
"""

FRAGMENT = """
void main()
{
  vec3 n = normalize(normal);
  vec3 v = normalize(ub.eye.xyz - ub.eye.w * world);
  vec3 r = 2.0 * dot(n, v) * n - v;
  float c = dot(r, ub.v_a.xyz);
  float s = dot(r, ub.a_perp.xyz);
  float t = atan(s, c) * ub.shape.x;
  // Width of a pixel in t, from c and s instead of t: the branch cut of atan has no derivative.
  float across = abs(c * dFdx(s) - s * dFdx(c)) + abs(c * dFdy(s) - s * dFdy(c));
  float pixel = across * ub.shape.x / max(c * c + s * s, 1e-12);
  float width = ub.shape.y;
  float from_center = abs(fract(t + 0.5) - 0.5);  // a line light stands at theta = 0
  float edge = max(max(0.7 * pixel, 0.5 * ub.shape.z * min(width, 1.0 - width)), 1e-5);
  float light = 1.0 - smoothstep(-edge, edge, from_center - 0.5 * width);
  light = mix(light, width, smoothstep(0.4, 0.8, pixel));  // too fine to be drawn: their mean
  vec4 color = mix(ub.gap_color, ub.color, light);
  fragColor = vec4(color.rgb, color.a * ub.opacity.x);
}
"""


def compile_shader() -> gpu.types.GPUShader:
    """In a window only: without one Blender 3.4 crashes in the first of these calls."""
    info = gpu.types.GPUShaderCreateInfo()
    info.typedef_source(STRUCT)
    info.uniform_buf(0, "StripeData", "ub")
    info.vertex_in(0, 'VEC3', "pos")
    info.vertex_in(1, 'VEC3', "nor")
    between = gpu.types.GPUStageInterfaceInfo("stripes_iface")
    between.smooth('VEC3', "world")
    between.smooth('VEC3', "normal")
    info.vertex_out(between)
    info.fragment_out(0, 'VEC4', "fragColor")
    info.vertex_source(VERTEX)
    info.fragment_source(FRAGMENT)
    return gpu.shader.create_from_info(info)
