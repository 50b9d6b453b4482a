"""The shader of the stripes: the solver's theta (paper, eq. 1), evaluated in every pixel."""
import gpu

from .stripes import RAMPS

STRUCT = """
struct StripeData {
  mat4 mvp; mat4 model; mat4 normals;
  vec4 depth_axis; vec4 eye; vec4 v_a; vec4 a_perp; vec4 line; vec4 shape; vec4 color; vec4 gap_color; vec4 paint;
};
"""

VERTEX = """
void main()
{
  vec4 clip = ub.mvp * vec4(pos, 1.0);
  // z is taken as if the point were nearer to the eye by a fraction of its distance; x and y stay.
  vec4 nearer = clip + ub.depth_axis * (ub.shape.w * (ub.depth_axis.w != 0.0 ? clip.w : 1.0));
  gl_Position = vec4(clip.xy, nearer.z / nearer.w * clip.w, clip.w);
  world = (ub.model * vec4(pos, 1.0)).xyz;
  normal = (ub.normals * vec4(nor, 0.0)).xyz;
  fraction = val;
}
"""

BAND = """
// Light of the stripes at the angle of (c, s), with `rate` line lights a radian.
float band(float c, float s, float rate)
{
  float t = atan(s, c) * rate;
  // Width of a pixel in t, from c and s instead of t: the branch cut of atan has no derivative.
  float across = abs(c * dFdx(s) - s * dFdx(c)) + abs(c * dFdy(s) - s * dFdy(c));
  float pixel = across * rate / max(c * c + s * s, 1e-12);
  float width = ub.shape.y;
  float from_center = abs(fract(t + 0.5) - 0.5);  // a line light stands at angle 0
  float edge = max(max(0.7 * pixel, 0.5 * ub.shape.z * min(width, 1.0 - width)), 1e-5);
  float light = 1.0 - smoothstep(-edge, edge, from_center - 0.5 * width);
  return mix(light, width, smoothstep(0.4, 0.8, pixel));  // too fine to be drawn: their mean
}
"""

ENVIRONMENT = """
// Colour of the image in a world direction, laid out as Blender's environment textures are. The texture has one more
// column at each end, a copy of the other end's, so that its filter knows no seam.
vec3 environment_color(vec3 d)
{
  float columns = float(textureSize(environment, 0).x);
  float u = fract(0.5 - atan(d.y, d.x) / 6.283185307179586 + ub.paint.z);
  float v = atan(d.z, length(d.xy)) / 3.141592653589793 + 0.5;
  return texture(environment, vec2((u * (columns - 2.0) + 1.0) / columns, v)).rgb;
}

// Mean of four points of the pixel.
vec3 mirrored_color(vec3 r)
{
  vec3 x = dFdx(r), y = dFdy(r);
  return 0.25 * (environment_color(r + 0.125 * x + 0.375 * y) + environment_color(r - 0.375 * x + 0.125 * y) +
                 environment_color(r - 0.125 * x - 0.375 * y) + environment_color(r + 0.375 * x - 0.125 * y));
}
"""

FRAGMENT = """
void main()
{
  if (ub.paint.w != 0.0 && gl_FragCoord.x * sign(ub.paint.w) < ub.paint.w) discard;
  vec3 n = normalize(normal);
  vec3 v = normalize(ub.eye.xyz - ub.eye.w * world);
  vec3 r = 2.0 * dot(n, v) * n - v;
  vec3 a = ub.line.xyz;
  int mode = int(ub.paint.y + 0.5);
  vec4 color;
  if (mode == 3) {
    color = vec4(mirrored_color(r), 1.0);
  }
  else if (mode == 4) {
    color = vec4(residual_color(fraction), 1.0);
  }
  else if (mode == 5) {
    color = vec4(deviation_color(0.5 + 0.5 * fraction), 1.0);
  }
  else if (mode == 6) {
    color = vec4(verdict_color(0.5 + 0.5 * fraction), 1.0);
  }
  else {
    // A normal turns half as much as its reflection: twice the rate draws the stripes as densely in all three modes.
    vec3 direction = mode == 0 ? r : n;
    float rate = mode == 0 ? ub.shape.x : 2.0 * ub.shape.x;
    float c = mode == 2 ? dot(n, a) : dot(direction, ub.v_a.xyz);
    float s = mode == 2 ? length(cross(n, a)) : dot(direction, ub.a_perp.xyz);
    color = mix(ub.gap_color, ub.color, band(c, s, rate));
  }
  fragColor = color;
}
"""


def write_ramp_source(name: str, ramp: tuple) -> str:
    """Returns the GLSL source of stripes.compute_ramp, as a function of this name."""
    colors = [f"vec3({r:.6f}, {g:.6f}, {b:.6f})" for r, g, b in ramp]
    steps = "".join(f"  c = mix(c, {color}, clamp(x - {k}.0, 0.0, 1.0));\n" for k, color in enumerate(colors[1:]))
    return (f"vec3 {name}(float given)\n{{\n  float x = clamp(given, 0.0, 1.0) * {len(ramp) - 1}.0;\n"
            f"  vec3 c = {colors[0]};\n{steps}  return c;\n}}\n")


def compile_shader() -> gpu.types.GPUShader:
    """Compiles the shader. Needs a window: without one Blender 3.4 crashes in the first of these calls."""
    info = gpu.types.GPUShaderCreateInfo()
    info.typedef_source(STRUCT)
    info.uniform_buf(0, "StripeData", "ub")
    info.sampler(0, 'FLOAT_2D', "environment")
    info.vertex_in(0, 'VEC3', "pos")
    info.vertex_in(1, 'VEC3', "nor")
    info.vertex_in(2, 'FLOAT', "val")
    between = gpu.types.GPUStageInterfaceInfo("stripes_iface")
    between.smooth('VEC3', "world")
    between.smooth('VEC3', "normal")
    between.smooth('FLOAT', "fraction")
    info.vertex_out(between)
    info.fragment_out(0, 'VEC4', "fragColor")
    info.vertex_source(VERTEX)
    ramps = "".join(write_ramp_source(f"{mode.lower()}_color", ramp) for mode, ramp in RAMPS.items())
    info.fragment_source(BAND + ENVIRONMENT + ramps + FRAGMENT)
    return gpu.shader.create_from_info(info)
