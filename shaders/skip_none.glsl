// No structure: everything may matter, so there is nothing to ask and skip_probe does not exist (walk.glsl, without SKIP).
