"""What Catch2 writes of comparisons that failed, and what the kit says of them."""

# The original, its expansion, what was expected and what came instead; all as they stand in XML.
COMPARISONS = [
    (
        "!(is_lit(scene, hit, light))",
        "!true",
        "is_lit(scene, hit, light) = false",
        "is_lit(scene, hit, light) = true",
    ),
    ("is_lit(scene, hit)", "false", "is_lit(scene, hit) = true", "is_lit(scene, hit) = false"),
    ("!(a) == !(b)", "true == false", "!(a) = false", "!(a) = true"),
    ("light.r == about(1.0)", "nanf == 1 within 0.0001", "light.r = 1 within 0.0001", "light.r = nan"),
    ("dark == 0", "384 (0x180) == 0", "dark = 0", "dark = 384"),
    (
        "part-&gt;enter == about(4.0)",
        "3.5f == 4 within 0.0004",
        "part-&gt;enter = 4 within 0.0004",
        "part-&gt;enter = 3.5",
    ),
    (
        "f(a &lt; b, {c, d}) &lt;= k_off",
        "0.25f &lt;= 0.001f",
        "f(a &lt; b, {c, d}) &lt;= 0.001",
        "f(a &lt; b, {c, d}) = 0.25",
    ),
    (
        "frame.up, IsNear({0.0F, -1.0F, 0.0F})",
        "(0, 1, 0) is expected to be (0, -1, 0) within 0.0001",
        "frame.up = (0, -1, 0) within 0.0001",
        "frame.up = (0, 1, 0)",
    ),
    (
        "mirror(d, n), IsUnitLength()",
        "(2, 0, 0) is expected to have length 1 within 0.0001",
        "mirror(d, n) has length 1 within 0.0001",
        "mirror(d, n) = (2, 0, 0)",
    ),
    (
        "!(ball.intersect({{0.0F, 1.5F, 5.0F}, -down}).has_value())",
        "!true",
        "ball.intersect({{0, 1.5, 5}, -down}).has_value() = false",
        "ball.intersect({{0, 1.5, 5}, -down}).has_value() = true",
    ),
    (
        "shade(hit, std::vector&lt;Light&gt;{{5.0F * up(1e-3F), k_white}}), IsNear(k_white)",
        "(0, 0, 0) is expected to be (1, 1, 1) within 0.00017",
        "shade(hit, {{5 * up(1e-3), k_white}}) = (1, 1, 1) within 0.00017",
        "shade(hit, {{5 * up(1e-3), k_white}}) = (0, 0, 0)",
    ),
    (
        "glm::dot(a, n1) / static_cast&lt;float&gt;(camera.width) == about(0.5)",
        "2.0f == 0.5 within 0.0001",
        "dot(a, n1) / camera.width = 0.5 within 0.0001",
        "dot(a, n1) / camera.width = 2.0",
    ),
    ("a &lt; b", "something else", "a &lt; b", "something else"),
    ("list == other", "{ 1, 2 } == { 1, 3 }", "list = { 1, 3 }", "list = { 1, 2 }"),
]
