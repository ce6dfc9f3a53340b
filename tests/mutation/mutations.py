"""The rules that are broken one at a time, and by which test each is expected to be noticed.

A text has to occur exactly once in its file. A catcher is PROGRAM:FILTER, a GoogleTest program under tests/ and its
filter, or hard_cases:CASE,CASE. None compares with hashes of earlier pictures: those notice everything and prove
nothing.
"""
from typing import NamedTuple


class Mutation(NamedTuple):
    name: str
    file: str
    text: str
    replacement: str
    catcher: str


SETUP = "raster/tile/setup.inl"
STAGES = "raster/fragment/stages/"

MUTATIONS = [
    # ---- coverage
    Mutation("snapping rounds down", "raster/vertex/vertex_stage.cpp",
             "hn::Floor(hn::Add(ideal, hn::Set(d, 0.5)))", "hn::Floor(ideal)",
             "coverage_test:Coverage.CornersAreSnappedToTheNearestGridPoint"),
    Mutation("a bottom edge owns its pixels, not a top edge", SETUP,
             "hn::And(hn::Eq(dy, zero), hn::Lt(dx, zero))", "hn::And(hn::Eq(dy, zero), hn::Gt(dx, zero))",
             "coverage_test:Coverage.CornersOnPixelCentres"),
    Mutation("right edges own their pixels, not left ones", SETUP,
             "hn::Or(hn::Lt(dy, zero), hn::And(", "hn::Or(hn::Gt(dy, zero), hn::And(",
             "coverage_test:Coverage.CornersOnPixelCentres"),
    Mutation("both sides own a shared edge", SETUP,
             "hn::IfThenZeroElse(inclusive, one)", "hn::IfThenZeroElse(inclusive, zero)",
             "hard_cases:mesh_pixel_centres"),
    Mutation("edge values are divided by one bit too many", SETUP,
             "e = hn::Floor(hn::Mul(e, hn::Set(d, 1.0 / kSubpixelScale)))",
             "e = hn::Floor(hn::Mul(e, hn::Set(d, 0.5 / kSubpixelScale)))",
             "hard_cases:mesh_random"),
    Mutation("tiles whose edge value is zero are left out", "raster/primitive/binning.cpp",
             "(e0.value | e1.value | e2.value) >= 0", "e0.value > 0 && e1.value > 0 && e2.value > 0",
             "coverage_test:Coverage.EdgesThroughTheCornersOfTiles"),
    Mutation("the scissor takes one column more", "raster/draw_area.h",
             "intersect(whole, state.raster.scissor)",
             "intersect(whole, Rect{state.raster.scissor.x0, state.raster.scissor.y0, state.raster.scissor.x1 + 1, "
             "state.raster.scissor.y1})",
             "translation_test:Translation.CuttingLeavesThePixelsInside"),

    # ---- draws that wait for another thread
    Mutation("an image goes before draws that wait", "raster/device.cpp",
             "const bool keep = is_small(packet);\n  filling->take_up_waiting(*target);",
             "const bool keep = is_small(packet);", "waiting_draws_test:*"),
    Mutation("draws that share a record keep the numbers of their vertices", "raster/waiting_draws.cpp",
             "if (first_vertex_ != 0) renumber();", "", "waiting_draws_test:*"),
    Mutation("draws share a record whatever their states", "raster/waiting_draws.cpp",
             "draw.joins = draw.state == program.state.get();", "draw.joins = true;", "waiting_draws_test:*"),

    # ---- clipping
    Mutation("a new corner depends on the end it is reckoned from", "raster/primitive/clip.cpp",
             "out.push(crossing_corner(*current, d, *previous, d_previous, has_user))",
             "out.push(crossing_corner(*previous, d_previous, *current, d * 1.5, has_user))",
             "hard_cases:mesh_near_plane,mesh_user_plane,mesh_guard_band"),
    Mutation("the near plane is at z = 0", "raster/primitive/clip.cpp",
             "{kOutNear, 0, 0, 1, 1, 0}", "{kOutNear, 0, 0, 1, 0, 0}",
             "clip_test:Clip.FloorThroughTheEye"),
    Mutation("the guard band is wider than edge functions reach", "raster/vertex/vertex_stage.cpp",
             "double(kGuardBandMax) * kSubpixelScale - offset", "64 * double(kGuardBandMax) * kSubpixelScale - offset",
             "hard_cases:mesh_far_vertices,mesh_guard_band"),
    Mutation("a cut polygon is fanned from its lowest corner, however snapping bent it", "raster/primitive/clip.cpp",
             "if (is_good_apex(p, count, apex, area)) return apex;", "if (area != 0) return apex;",
             "clip_test:Clip.ABentRemainderIsDrawnOnce"),
    Mutation("triangles cut together are fanned from their lowest corners, too", "raster/primitive/triangle_cut.cpp",
             "return hn::Ge(least, zero);", "return hn::Eq(zero, zero);",
             "raster_triangle_cut_test:TriangleCut.PiecesAreTheClippers"),

    # ---- planes
    Mutation("the reference vertex is the first one given", "raster/tile/setup_gather.inl",
             "third_first = hn::AndNot(second_first, c_first)",
             "third_first = hn::MaskFromVec(hn::Zero(d))",
             "translation_test:Translation.OrderOfVerticesChangesNothing"),
    Mutation("colours are scaled by 256", SETUP,
             "LoadAttribute(in, layout, a, k, i), hn::Set(d, 255.0)", "LoadAttribute(in, layout, a, k, i), hn::Set(d, 256.0)",
             "color_test:Color.EveryByteComesBack"),
    Mutation("attributes are not divided by w", SETUP,
             "by_w = hn::Mul(value[k], inv_w[k])", "by_w = value[k]",
             "color_test:Color.PerspectiveGradientsRoundToNearest"),
    Mutation("corners lie where they were snapped to", SETUP,
             "auto use = hn::Le(longest, half)", "auto use = hn::Lt(longest, hn::Zero(d))",
             "color_test:Color.GradientsRoundToNearest"),
    Mutation("whole repeats stay in the coordinate", SETUP,
             "return hn::Floor(middle)", "return hn::Mul(hn::Zero(d), middle)",
             "hard_cases:texcoord_offsets"),
    Mutation("what is asked of all colours at once lets every triangle through as floats", SETUP,
             "return hn::Le(left, right);", "return hn::Ge(hn::Abs(left), hn::Zero(d));",
             "precision_test:PrecisionOnDemand.ColoursOfSliversAreNeverFartherOffThanDerived"),
    Mutation("cut triangles take floats whatever they are", "raster/tile/cut_planes.inl",
             "static_cast<uint8_t>(fails[k])", "0",
             "precision_test:PrecisionOnDemand.CoordinatesOfCutTrianglesAreAsNear"),
    Mutation("the closer look lets every plane through as floats", "raster/tile/corner_bounds.inl",
             "hn::And(maker.needs_double, bounds.fails)", "hn::AndNot(maker.needs_double, bounds.fails)",
             "precision_test:*"),
    Mutation("on mip levels any coordinate will do", "raster/tile/corner_bounds.inl",
             "hn::Sqrt(hn::Mul(hn::Sqrt(squared), hn::Set(d, 1 / 2.05)))", "hn::Sqrt(hn::Mul(hn::Sqrt(squared), hn::Set(d, 1e9)))",
             "precision_test:*"),
    Mutation("smooth colours are not held to 255", STAGES + "color.inl",
             "x = HeldBelow(x, hn::Set(DF(), 255.0f))", "x = HeldBelow(x, hn::Set(DF(), 300.0f))",
             "color_test:Color.NothingIsBrighterThanWhite"),
    Mutation("the first vertex of a triangle provokes", "raster/primitive/patterns.h",
             "struct ListTriangles {\n  static constexpr uint8_t kProvoking = 2",
             "struct ListTriangles {\n  static constexpr uint8_t kProvoking = 0",
             "color_test:FlatShading.ProvokingVertex"),

    # ---- depth
    Mutation("depth is cut off, not rounded", SETUP,
             "hn::Add(hn::Load(d, out.f0[0] + i), hn::Set(d, 0.5))", "hn::Load(d, out.f0[0] + i)",
             "depth_test:Depth.NearestIntegerAtEveryPixel"),
    Mutation("depth is scaled by 2^24", SETUP,
             "kDepthScale = static_cast<double>(kDepthMax)", "kDepthScale = static_cast<double>(kDepthMax) + 1",
             "depth_test:Depth.NearestIntegerAtEveryPixel"),
    Mutation("a slope is the sum of both", SETUP,
             "depth_offset(polygon, gx > gy ? gx : gy)", "depth_offset(polygon, gx + gy)",
             "polygon_offset_test:PolygonOffset.FactorIsOfTheSlope"),
    Mutation("offsets are half as large", "raster/primitive/shape_plan.cpp",
             "double(polygon.offset_units);", "0.5 * double(polygon.offset_units);",
             "polygon_offset_test:PolygonOffset.UnitsAreStepsOfTheDepthBuffer"),

    # ---- fragments
    Mutation("blends are cut off, not rounded", "raster/fragment/bytes.inl",
             "hn::Add(x, hn::Set(DU(), 0x00800080u))", "x", "hard_cases:blend_triples,thousand_blends"),
    Mutation("blends are divided by 256", "raster/fragment/bytes.inl",
             "hn::Set(DU(), 0x01010101u)", "hn::Set(DU(), 0x01000100u)",
             "hard_cases:blend_triples,thousand_blends"),
    Mutation("colours are cut off on their way to memory", "raster/fragment/bytes.inl",
             "TruncateInRange(hn::Add(v, hn::Set(DF(), 0.5f)))", "TruncateInRange(v)",
             "color_test:Color.GradientsRoundToNearest"),
    Mutation("alpha is compared the other way round", STAGES + "alpha_test.inl",
             "Passes(c.params->alpha_func, v.slot[kA], reference)", "Passes(c.params->alpha_func, reference, v.slot[kA])",
             "blend_test:AlphaTest.ComparesBytesExactly"),
    Mutation("the stencil mask is not applied to the reference", STAGES + "stencil.inl",
             "s.reference & s.compare_mask", "s.reference", "stencil_test:Stencil.IsAsDefined"),
    Mutation("stencil: hidden fragments count as drawn", STAGES + "stencil.inl",
             "Changed(s.depth_fail, old, s)", "Changed(s.depth_pass, old, s)", "stencil_test:Stencil.IsAsDefined"),
    Mutation("fog: what is far is clear", STAGES + "fog.inl",
             "hn::Mul(f, color), hn::Mul(rest, hn::Set(d, fog.color[k]))",
             "hn::Mul(rest, color), hn::Mul(f, hn::Set(d, fog.color[k]))", "hard_cases:fog_ends"),
    Mutation("fog: EXP2 forgets to square", STAGES + "fog.inl",
             "ExpMinus(hn::Mul(x, x))", "ExpMinus(x)", "fog_test:Fog.FactorIsWithinTenToTheMinusFive"),

    Mutation("what groups draw over is shaded all the same", "raster/tile/group_walk.inl",
             "if ((t.deferred.blocks & blocks) != 0) t.deferred.DropGroups(c.groups, c.group_count);", "",
             "deferred_colors_test:*"),
    Mutation("what packed pixels draw over is shaded all the same", "raster/tile/tile_worker.cpp",
             "t.deferred.DropListed(queue.offset, queue.count);", ";", "deferred_colors_test:*"),
    Mutation("a block is as deep as its nearest pixel", "raster/tile/hidden_triangles.inl",
             "deepest = hn::Max(deepest, hn::Load(d, pixels + i))", "deepest = hn::Min(deepest, hn::Load(d, pixels + i))",
             "hidden_triangles_test:*"),
    Mutation("blending does not wait for colours it looks at", "raster/tile/deferred_pixels.inl",
             "draw.program->covers && ", "", "deferred_colors_test:*"),

    # ---- textures
    Mutation("lambda: the sum of both gradients", STAGES + "lambda.inl",
             "rho2.part[p] = hn::Div(hn::Max(row, columns), hn::Mul(q2, q2))", "rho2.part[p] = hn::Div(hn::Add(row, columns), hn::Mul(q2, q2))",
             "mipmap_test:Mipmap.LambdaWithinASixtyFourth"),
    Mutation("lambda in float: the shorter gradient", STAGES + "lambda.inl",
             "hn::Max(FillRows(", "hn::Min(FillRows(", "mipmap_test:Mipmap.LambdaWithinASixtyFourth"),
    Mutation("lambda: half of it is missing", STAGES + "lambda.inl",
             "hn::Mul(hn::Set(d, 0.5f), Log2(rho2))", "Log2(rho2)", "hard_cases:lod_ramp"),
    Mutation("NEAREST mip level: one too high", STAGES + "levels.inl",
             "hn::Sub(hn::Ceil(hn::Add(clamped, hn::Set(d, 0.5f))), hn::Set(d, 1.0f))",
             "hn::Ceil(hn::Add(clamped, hn::Set(d, 0.5f)))", "mipmap_test:Mipmap.NearestLevel"),
    Mutation("REPEAT truncates below zero", STAGES + "sample.inl",
             "if (wrap == Wrap::repeat) s = hn::Sub(s, hn::Floor(s));",
             "if (wrap == Wrap::repeat) s = hn::Sub(s, hn::Trunc(s));",
             "texture_test:TextureRepeat.JustBelowNoughtIsTheLastTexel"),
    Mutation("NEAREST at a texel's edge takes the texel before", STAGES + "sample.inl",
             "TruncateInRange(hn::Add(scaled, hn::Set(d, 0.5f)))", "TruncateInRange(hn::Sub(scaled, hn::Set(d, 0.5f)))",
             "texture_test:TextureNearest.TexelEdgesPickTheTexelAboveThem"),
    Mutation("NEAREST of a repeated texture takes the texel before, at a texel's edge", STAGES + "sample.inl",
             "hn::Add(hn::Mul(s, scale), hn::Set(DF(), 0.5f))", "hn::Sub(hn::Mul(s, scale), hn::Set(DF(), 0.5f))",
             "hard_cases:texture_seams"),

    # ---- lines and points
    Mutation("diamonds contain their boundary", "raster/tile/cover_line.cpp",
             "sign_moved(sx * (x - cx) + sy * (y - cy) - kHalf, sx, sy) >= 0", "sx * (x - cx) + sy * (y - cy) - kHalf > 0",
             "lines_test:DiamondExit.AllEndpointPairsOnASixteenthGrid"),
    Mutation("a line ends with its last pixel", "raster/tile/line_setup.inl",
             "return hn::AndNot(ends, reaches);", "return hn::AndNot(hn::AndNot(ends, ends), reaches);",
             "lines_test:DiamondExit.*"),
    Mutation("stipple starts at its second bit", "raster/tile/cover_line.cpp",
             "(stipple.start + index) / uint32_t(stipple.repeat)", "(stipple.start + index + 1) / uint32_t(stipple.repeat)",
             "shapes_test:StippledLines.*"),
    Mutation("points of even size stand a pixel off", "raster/tile/cover_line.cpp",
             "size % 2 == 0 ? kSubpixelScale / 2 : 0", "0", "hard_cases:point_phases"),

    # ---- vertices and matrices
    Mutation("matrices multiply from the left", "state/transform.cpp",
             "multiply(top.data(), m).data()", "multiply(m, top.data()).data()",
             "state_matrix_test:MatrixTest.CommandsMultiplyFromTheRightLikeGlm"),
    Mutation("specular light shines from behind, too", "raster/vertex/lighting.inl",
             "sums.specular[0].add(hn::IfThenElseZero(lit, shine), light.specular)",
             "sums.specular[0].add(shine, light.specular)", "lighting_test:Lighting.IsTheSpecsFormula"),
    Mutation("specular exponent is off by one", "raster/vertex/lighting.inl",
             "FloatVec shininess = sides[0].shininess.get(0, i);",
             "FloatVec shininess = hn::Add(sides[0].shininess.get(0, i), hn::Set(Floats(), 1.0f));",
             "lighting_test:Lighting.IsTheSpecsFormula"),
    Mutation("light that is scattered back is not cut off", "raster/vertex/lighting.inl",
             "sums.diffuse[0].add(hn::Mul(weight, positive_part(cosine)), light.diffuse)",
             "sums.diffuse[0].add(hn::Mul(weight, hn::Abs(cosine)), light.diffuse)",
             "lighting_test:Lighting.IsTheSpecsFormula"),
]
