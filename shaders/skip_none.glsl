// No structure: everything may matter, so there is nothing to ask and skip_step does not exist (walk.glsl, without SKIP).
