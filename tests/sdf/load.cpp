// Reads a world as Gazebo does, and prints what it found as JSON.
//
//     load WORLD
//
// Exits with 1 and the complaints of libsdformat if there are any, warnings too.

#include <cstdio>

#include <sdf/sdf.hh>

static void pose(const ignition::math::Pose3d &pose)
{
  const auto &p = pose.Pos();
  const auto &q = pose.Rot();
  std::printf("\"place\": [%.9g, %.9g, %.9g], \"turn\": [%.9g, %.9g, %.9g, %.9g]", p.X(), p.Y(), p.Z(), q.W(), q.X(),
              q.Y(), q.Z());
}

static bool shape(const sdf::Geometry &geometry)
{
  if (const auto *box = geometry.BoxShape()) {
    const auto size = box->Size();
    std::printf(", \"box\": [%.9g, %.9g, %.9g]", size.X(), size.Y(), size.Z());
  } else if (geometry.PlaneShape()) {
    const auto normal = geometry.PlaneShape()->Normal();
    std::printf(", \"plane\": [%.9g, %.9g, %.9g]", normal.X(), normal.Y(), normal.Z());
  } else if (const auto *mesh = geometry.MeshShape()) {
    std::printf(", \"mesh\": \"%s\", \"part\": \"%s\"", mesh->Uri().c_str(), mesh->Submesh().c_str());
  } else if (geometry.Element()->HasElement("polyline")) {
    // Only later versions have a class for it.
    const auto polyline = geometry.Element()->GetElement("polyline");
    std::printf(", \"height\": %.9g, \"points\": [", polyline->Get<double>("height"));
    for (auto point = polyline->GetElement("point"); point; point = point->GetNextElement("point")) {
      const auto p = point->Get<ignition::math::Vector2d>();
      std::printf("%s[%.9g, %.9g]", point == polyline->GetElement("point") ? "" : ", ", p.X(), p.Y());
    }
    std::printf("]");
  } else {
    return false;
  }
  return true;
}

template <typename Part> static bool part(const char *kind, const Part *found, bool first)
{
  ignition::math::Pose3d at;
  if (!found->SemanticPose().Resolve(at, "__model__").empty())
    return false;
  std::printf("%s\n  {\"kind\": \"%s\", \"name\": \"%s\", ", first ? "" : ",", kind, found->Name().c_str());
  pose(at);
  const bool known = shape(*found->Geom());
  std::printf("}");
  return known;
}

int main(int count, char **arguments)
{
  if (count != 2)
    return 2;
  auto config = sdf::ParserConfig::GlobalConfig();
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  sdf::Root root;
  const auto errors = root.Load(arguments[1], config);
  for (const auto &error : errors)
    std::fprintf(stderr, "%s\n", error.Message().c_str());
  if (!errors.empty() || root.WorldCount() != 1 || root.WorldByIndex(0)->ModelCount() != 1)
    return 1;
  const auto *world = root.WorldByIndex(0);
  const auto *model = world->ModelByIndex(0);
  const auto *link = model->LinkByIndex(0);
  bool known = model->LinkCount() == 1 && model->RawPose() == ignition::math::Pose3d::Zero;
  std::printf("{\"world\": \"%s\", \"version\": \"%s\", \"static\": %s, \"lights\": %lu, \"step\": %.9g, \"parts\": [",
              world->Name().c_str(), root.Version().c_str(), model->Static() ? "true" : "false",
              static_cast<unsigned long>(world->LightCount()), world->PhysicsDefault()->MaxStepSize());
  for (uint64_t n = 0; n < link->VisualCount(); ++n)
    known &= part("visual", link->VisualByIndex(n), n == 0);
  for (uint64_t n = 0; n < link->CollisionCount(); ++n)
    known &= part("collision", link->CollisionByIndex(n), false);
  std::printf("\n]}\n");
  return known ? 0 : 1;
}
