#include <gtest/gtest.h>
#include <pfem_fluid/given_nodes.h>
#include <pfem_fluid/gmsh_mesh.h>
#include <unit/base/message_of.h>

#include <filesystem>
#include <fstream>

using namespace Breakwater;

namespace
{
  /// A file that is gone when the test is over.
  class TemporaryFile
  {
  public:
    explicit TemporaryFile(const std::string &text)
      : name_(::testing::TempDir() + "breakwater_gmsh_test.msh")
    {
      std::ofstream(name_) << text;
    }
    ~TemporaryFile() { std::filesystem::remove(name_); }
    const std::string &name() const { return name_; }

  private:
    std::string name_;
  };

  std::string with(std::string text, const std::string &old, const std::string &replacement)
  {
    return text.replace(text.find(old), old.size(), replacement);
  }

  /// The unit square in two triangles, with a line and a node that has no cell; node numbers with gaps.
  const std::string version_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                                "$Nodes\n5\n10 0 0 0\n11 1 0 0\n12 1 1 0\n20 0 1 0\n21 5 5 0\n$EndNodes\n"
                                "$Elements\n3\n1 1 2 1 1 10 11\n2 2 2 1 1 10 11 12\n3 2 2 1 1 10 12 20\n$EndElements\n";
  const std::string version_4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 1 1 0 0 0\n$EndEntities\n"
    "$Nodes\n2 5 10 21\n2 1 0 3\n10\n11\n12\n0 0 0\n1 0 0\n1 1 0\n2 1 0 2\n20\n21\n0 1 0\n"
    "5 5 0\n$EndNodes\n"
    "$Elements\n2 3 1 3\n1 1 1 1\n1 10 11\n2 1 2 2\n2 10 11 12\n3 10 12 20\n$EndElements\n";
} // namespace


TEST(GmshMesh, ReadsBothFormats)
{
  for (const std::string &text : {version_2, version_4, with(version_2, "10 0 0 0\n", "10 0 0 0\r\n")})
    {
      const TemporaryFile file(text);
      const GmshMesh      mesh = read_gmsh(file.name());
      ASSERT_EQ(mesh.position.size(), 5u);
      EXPECT_EQ(mesh.position[2][1], 1.);
      EXPECT_EQ(mesh.position[3][0], 0.);
      EXPECT_EQ(mesh.lines, (std::vector<std::array<unsigned int, 2>>{{{0, 1}}}));
      EXPECT_EQ(mesh.triangles, (std::vector<std::array<unsigned int, 3>>{{{0, 1, 2}}, {{0, 2, 3}}}));
      EXPECT_TRUE(mesh.tetrahedra.empty());
    }
}


TEST(GmshMesh, SaysWhatIsWrongInWhichLine)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
    {"solid tank\n", ":1: a gmsh file starts with $MeshFormat"},
    {with(version_2, "2.2 0", "4 0"), ":2: format 4 can't be read"},
    {with(version_2, "2.2 0", "2.2 1"), ":2: binary files can't be read"},
    {with(version_2, "11 1 0 0", "11 1 zero 0"), ":7: expected 4 numbers or more, found \"11 1 zero 0\""},
    {with(version_2, "1 10 11 12", "1 10 11 99"), ":15: node 99 is not in the file"},
    {with(version_2, "10 12 20\n$EndElements\n", "10 12"), ":16: an element of 3 nodes is expected"},
    {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n", ":5: the file ends too early"},
    {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "the file has no nodes"}};
  for (const auto &[text, expected] : cases)
    {
      const TemporaryFile file(text);
      const std::string   message = message_of([&]() {
        read_gmsh(file.name());
      });
      EXPECT_NE(message.find(expected), std::string::npos) << message << " instead of " << expected;
    }
}


TEST(MeshRegion, TakesTheNodesThatHaveCellsAndKnowsWhatIsInside)
{
  const TemporaryFile file(version_2);
  const MeshRegion<2> region(file.name());
  NodeCandidates<2>   nodes;
  region.add_nodes(SizeField<2>(0.1), {}, nodes);
  EXPECT_EQ(nodes.given.size(), 4u);
  for (const Vec<2> &x : {Vec<2>{{0.2, 0.7}}, Vec<2>{{0.9, 0.1}}, Vec<2>{{0, 0}}, Vec<2>{{0.5, 0.5}}})
    EXPECT_LT(region.distance(x), 0.);
  for (const Vec<2> &x : {Vec<2>{{-0.1, 0.7}}, Vec<2>{{1.01, 0.1}}, Vec<2>{{5, 5}}})
    EXPECT_GT(region.distance(x), 0.);
  EXPECT_NE(message_of([&]() {
              MeshRegion<3> solid(file.name());
            }).find("has no tetrahedra"),
            std::string::npos);
}
