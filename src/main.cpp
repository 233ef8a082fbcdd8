#include "device/device.h"
#include "scene/gltf_loader.h"
#include "scene/camera.h"
#include "film/exr_writer.h"
#include "film/png_writer.h"
#include "wavefront/renderer.h"
#include <cstdio>
#include <cstdlib>
using namespace wavepath;
int main(int argc,char**argv){ try{
 prepare_environment();
 auto device=open_device("");
 Scene s=load_gltf(argv[1]);
 RenderSettings st; st.width=st.height=argc>3?atoi(argv[3]):256; st.samples=argc>2?atoi(argv[2]):64;
 if(getenv("METHOD")) st.method=method_named(getenv("METHOD"));
 if(getenv("ENVR")) {s.environment=Environment{}; s.environment->radiance={1,1.1f,1.3f};}
 if(getenv("POOL")) st.pool=atoi(getenv("POOL"));
 if(getenv("SEED")) st.seed=atoi(getenv("SEED"));
 st.camera=choose_camera(s,normalise(s),"");
 auto r=render(device,s,st);
 printf("norm %.3f bvh %.3f up %.3f prog %.3f render %.3f  it %lu  Ms/s %.3f relerr %.4g nonfinite %lu nodes %zu blocks %zu\n",r.times.normalise,r.times.bvh_build,r.times.upload,r.times.program_build,r.times.render,r.iterations,st.width*st.height*double(r.samples)/r.times.render/1e6,r.film.relative_error,r.film.nonfinite.samples,r.bvh_nodes,r.bvh_blocks);
 double tot=0; for(auto&p:r.profile) tot+=p.seconds;
 for(auto&p:r.profile) printf("%-18s %6lu %10lu %8.4fs %5.1f%% %7.2f ns/item\n",p.name.c_str(),p.launches,p.items,p.seconds,100*p.seconds/r.times.render,1e9*p.seconds/p.items);
 printf("kernels %.1f%%\n",100*tot/r.times.render); for(auto l:r.path_lengths) printf("%lu ",l); puts("");
 write_exr(r.film.image,argc>4?argv[4]:"/tmp/o.exr"); write_png(r.film.image,"/tmp/o.png",0);
 }catch(std::exception&e){printf("error: %s\n",e.what());return 1;} }
