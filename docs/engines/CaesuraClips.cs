// Loops and plain names of Caesura's clips: put this into Assets/Editor. The animations of every NAME.glb that Caesura has
// cut become NAME/CLIP.anim; where NAME.json lies beside it, motions that it marks as loops do loop too. An .anim that is
// there already keeps its references.

using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text;
using UnityEditor;
using UnityEngine;

public sealed class CaesuraClips : AssetPostprocessor
{
    const string Suffix = "-loop";

    [Serializable]
    sealed class Gltf
    {
        public Animation[] animations = Array.Empty<Animation>();
    }

    [Serializable]
    sealed class Animation
    {
        public string name = "";
        public Extras extras = new();
    }

    [Serializable]
    sealed class Extras
    {
        public Clip caesura = new();
    }

    [Serializable]
    sealed class Clip
    {
        public string motion = "";
        public int start;
    }

    [Serializable]
    sealed class Result
    {
        public Segment[] segments = Array.Empty<Segment>();
    }

    [Serializable]
    sealed class Segment
    {
        public int start;
        public int end;
        public bool loop;
    }

    static void OnPostprocessAllAssets(string[] imported, string[] deleted, string[] moved, string[] movedFrom)
    {
        foreach (var path in imported.Where(path => path.EndsWith(".glb", StringComparison.OrdinalIgnoreCase)))
        {
            var loops = LoopsByName(path);
            if (loops.Count > 0)
            {
                Extract(path, loops);
            }
        }
    }

    // Whether a clip loops, by its name in the GLB; animations of the model that are no clips are not there.
    static Dictionary<string, bool> LoopsByName(string path)
    {
        var json = Path.ChangeExtension(path, ".json");
        var result = File.Exists(json) ? JsonUtility.FromJson<Result>(File.ReadAllText(json)) : new Result();
        var clips = ReadJsonOfGlb(path).animations.Where(animation => animation.extras.caesura.motion != "");
        return clips.ToDictionary(
            animation => animation.name,
            animation => animation.name.EndsWith(Suffix, StringComparison.Ordinal)
                || result.segments.Any(segment => segment.loop
                    && segment.start <= animation.extras.caesura.start && animation.extras.caesura.start < segment.end));
    }

    static Gltf ReadJsonOfGlb(string path)
    {
        using var reader = new BinaryReader(File.OpenRead(path));
        reader.ReadBytes(12); // magic, version and length
        var length = reader.ReadInt32();
        reader.ReadInt32();
        return JsonUtility.FromJson<Gltf>(Encoding.UTF8.GetString(reader.ReadBytes(length)));
    }

    static void Extract(string path, IReadOnlyDictionary<string, bool> loops)
    {
        var clips = AssetDatabase.LoadAllAssetsAtPath(path).OfType<AnimationClip>().Where(clip => !clip.legacy).ToList();
        if (clips.Count == 0)
        {
            Debug.LogWarning($"Caesura: {path} has no Mecanim clips. Set Animation to Mecanim in its import settings.");
            return;
        }
        var folder = Path.ChangeExtension(path, null);
        Directory.CreateDirectory(folder);
        foreach (var clip in clips.Where(clip => loops.ContainsKey(clip.name)))
        {
            var plain = clip.name.EndsWith(Suffix, StringComparison.Ordinal)
                ? clip.name.Substring(0, clip.name.Length - Suffix.Length)
                : clip.name;
            Save(clip, plain, loops[clip.name], $"{folder}/{plain}.anim");
        }
        AssetDatabase.SaveAssets();
    }

    static void Save(AnimationClip source, string name, bool loop, string path)
    {
        var clip = UnityEngine.Object.Instantiate(source);
        clip.name = name;
        var settings = AnimationUtility.GetAnimationClipSettings(clip);
        settings.loopTime = loop;
        AnimationUtility.SetAnimationClipSettings(clip, settings);
        var existing = AssetDatabase.LoadAssetAtPath<AnimationClip>(path);
        if (existing == null)
        {
            AssetDatabase.CreateAsset(clip, path);
        }
        else
        {
            EditorUtility.CopySerialized(clip, existing);
            EditorUtility.SetDirty(existing);
        }
    }
}
